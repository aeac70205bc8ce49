#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>

#include "cli/text.h"

namespace reprise::cli {
namespace {

constexpr std::size_t bar_width = 24;
constexpr std::size_t default_columns = 80;
constexpr std::chrono::milliseconds redraw_interval{100};

std::size_t terminal_columns(std::FILE* terminal) {
  winsize size = {};
  if (ioctl(fileno(terminal), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return default_columns;
  return size.ws_col;
}

}  // namespace

std::string progress_line(std::string_view what, const Progress& progress, double elapsed_seconds,
                          std::size_t columns) {
  const double total = static_cast<double>(std::max<std::size_t>(progress.total, 1));
  const double share = std::clamp(static_cast<double>(progress.done) / total, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(share * bar_width);
  std::string left;
  if (share > 0) left = format_clock(elapsed_seconds * (1 - share) / share) + " left";
  std::string line =
      fmt::format("{} [{}{}] {:3.0f} %  {}/{}  {}  {}", what, std::string(filled, '#'),
                  std::string(bar_width - filled, '-'), 100 * share, progress.done, progress.total,
                  left, printable(progress.current));
  if (line.size() > columns) line.resize(columns);
  return line;
}

ProgressBar::ProgressBar(std::string what, std::FILE* terminal)
    : what_(std::move(what)), terminal_(terminal) {}

ProgressBar::~ProgressBar() { hide(); }

void ProgressBar::hide() {
  if (!visible_) return;
  std::fputs("\r\033[K", terminal_);
  std::fflush(terminal_);
  visible_ = false;
}

void ProgressBar::show(const Progress& progress) {
  if (terminal_ == nullptr) return;
  const auto now = Clock::now();
  const bool done = progress.done >= progress.total;
  if (visible_ && !done && now - drawn_ < redraw_interval) return;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  // The last column stays free: some terminals wrap when it is written.
  const std::string line = progress_line(what_, progress, elapsed, terminal_columns(terminal_) - 1);
  std::fputs(("\r" + line + "\033[K").c_str(), terminal_);
  std::fflush(terminal_);
  drawn_ = now;
  visible_ = true;
}

}  // namespace reprise::cli
