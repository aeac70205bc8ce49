#include "reprise/synth/library.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "formats/whole_file.h"
#include "model/new_file.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "synth/channels.h"
#include "synth/take_maker.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;
using synth::LibraryPlan;
using synth::Subject;

std::vector<Subject> make_subjects(const SynthOptions& options, const LibraryPlan& plan) {
  std::vector<Subject> subjects;
  for (std::size_t i = 0; i < plan.subjects.size(); ++i) {
    subjects.push_back(synth::make_subject(options, plan.subjects[i], i));
  }
  return subjects;
}

/// Makes each take in turn and hands it on; returns the truth.
template <typename Receive>
std::vector<std::vector<SynthOccurrence>> make_takes(const SynthOptions& options,
                                                     const LibraryPlan& plan,
                                                     const std::vector<Subject>& subjects,
                                                     Receive receive) {
  std::vector<std::vector<SynthOccurrence>> truth;
  for (const std::size_t count : plan.occurrence_counts) truth.emplace_back(count);
  for (std::size_t i = 0; i < plan.takes.size(); ++i) {
    synth::MadeTake made = synth::make_take(options, plan, i, subjects[plan.takes[i].subject]);
    for (auto& occurrence : made.occurrences) {
      truth[occurrence.motif][occurrence.place] = std::move(occurrence.occurrence);
    }
    receive(std::move(made.take));
  }
  return truth;
}

std::string truth_text(const std::vector<std::vector<SynthOccurrence>>& truth,
                       const std::string& extension) {
  nlohmann::ordered_json groups = nlohmann::ordered_json::array();
  for (const auto& group : truth) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const SynthOccurrence& occurrence : group) {
      list.push_back({{"file", occurrence.file + extension},
                      {"start_s", occurrence.start_s},
                      {"end_s", occurrence.end_s},
                      {"speed", occurrence.speed},
                      {"noise", occurrence.noise}});
    }
    groups.push_back(std::move(list));
  }
  return groups.dump(1) + "\n";
}

void refuse_existing(const std::vector<fs::path>& paths) {
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) continue;
    throw Error(ErrorCode::failed, "the file exists already", {path.string(), 0},
                "choose another folder, or replace it with --overwrite");
  }
}

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) {
    throw Error(code_of_errno(problem.value()), "the folder cannot be made: " + problem.message(),
                {folder.string(), 0}, "check the permissions of the folder above it");
  }
}

}  // namespace

SynthLibrary make_synthetic_library(const SynthOptions& options) {
  const LibraryPlan plan = synth::plan_library(options);
  SynthLibrary library;
  library.truth = make_takes(options, plan, make_subjects(options, plan),
                             [&](Take take) { library.takes.push_back(std::move(take)); });
  return library;
}

std::size_t write_synthetic_library(const fs::path& folder, const SynthOptions& options,
                                    bool overwrite) {
  const LibraryPlan plan = synth::plan_library(options);
  const bool bvh = options.format == MotionFormat::bvh;
  const std::string extension = bvh ? ".bvh" : ".amc";
  const fs::path truth_path = folder / "truth.json";
  const auto asf_path = [&](const std::string& subject) {
    return folder / subject / (subject + ".asf");
  };

  std::vector<fs::path> paths = {truth_path};
  for (const auto& take : plan.takes) paths.push_back(folder / (take.name + extension));
  if (!bvh) {
    for (const std::string& subject : plan.subjects) paths.push_back(asf_path(subject));
  }
  if (!overwrite) refuse_existing(paths);

  const std::vector<Subject> subjects = make_subjects(options, plan);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    make_folder(folder / plan.subjects[i]);
    remove_dead_new_files(folder / plan.subjects[i]);
    if (!bvh) write_whole_file(asf_path(plan.subjects[i]), subjects[i].skeleton->source_text);
  }
  const auto truth = make_takes(options, plan, subjects, [&](const Take& take) {
    write_whole_file(folder / (take.name + extension), write_motion(take, synth::file_decimals));
  });
  write_whole_file(truth_path, truth_text(truth, extension));
  return paths.size();
}

}  // namespace reprise
