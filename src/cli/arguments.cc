#include "cli/arguments.h"

#include <algorithm>
#include <utility>

namespace reprise::cli {

std::vector<std::string> protected_arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  bool options_ended = false;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    if (argument == "--" && !options_ended) {
      options_ended = true;
      continue;
    }
    const bool like_list = argument.starts_with('[') && argument.ends_with(']');
    const bool like_option = options_ended && argument.starts_with('-');
    if (like_list || like_option) argument.insert(argument.begin(), '\0');
    arguments.push_back(std::move(argument));
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

std::string restored_argument(std::string argument) {
  if (argument.starts_with('\0')) argument.erase(argument.begin());
  return argument;
}

void restore_arguments(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) option->transform(restored_argument);
}

}  // namespace reprise::cli
