#include "store/terms.h"

#include "store/digest.h"

namespace reprise {
namespace {

/// Few, so that many keys fit a row. Of 30,000 words one in three shares its key with another,
/// which costs a block that is looked at in vain.
constexpr int term_key_bits = 16;

/// Persisted: never change a value.
enum class TermKind { word = 0, subject = 1, clip_kind = 2 };

std::int64_t finish_key(Hasher& hasher) {
  const Digest digest = hasher.finish();
  static_assert(term_key_bits == 16);
  return digest[0] << 8 | digest[1];
}

std::int64_t key_of(TermKind kind, const std::string& text) {
  Hasher hasher;
  hasher.add_number(static_cast<int>(kind));
  hasher.add_text(text);
  return finish_key(hasher);
}

std::int64_t key_of(ClipKind kind) {
  Hasher hasher;
  hasher.add_number(static_cast<int>(TermKind::clip_kind));
  hasher.add_number(static_cast<int>(kind));
  return finish_key(hasher);
}

void add_words(TermKeys& keys, const WordSplitter& splitter, const std::string& text) {
  for (const std::string& word : splitter.words(text)) keys.insert(key_of(TermKind::word, word));
}

}  // namespace

TermKeys terms_of(const TakeBlock& block, const WordSplitter& splitter) {
  TermKeys keys;
  std::string texts;
  std::set<std::string> subjects;
  std::set<ClipKind> kinds;
  for (const StoredTake& take : block.takes) {
    const TakeInfo& info = take.record.info;
    for (const std::string* text : {&info.name, &info.subject, &info.description, &info.tags})
      texts += *text + "\n";
    subjects.insert(info.subject);
    for (const StoredClip& clip : take.clips) kinds.insert(clip.kind);
  }
  add_words(keys, splitter, texts);
  subjects.erase("");
  for (const std::string& subject : subjects) keys.insert(key_of(TermKind::subject, subject));
  for (const ClipKind kind : kinds) keys.insert(key_of(kind));
  return keys;
}

TermKeys terms_of(const TakeFilter& filter, const WordSplitter& splitter) {
  TermKeys keys;
  add_words(keys, splitter, filter.text);
  if (!filter.subject.empty()) keys.insert(key_of(TermKind::subject, filter.subject));
  if (filter.kind) keys.insert(key_of(*filter.kind));
  return keys;
}

}  // namespace reprise
