// Arguments of the command line, kept from what the parser makes of some of them.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <vector>

namespace reprise::cli {

/// The arguments as the parser wants them, last first. It takes "[a,b]" for a list of two and
/// forgets "--" once it has what it needs; so what is no option though it may look like one gets a
/// NUL in front, which no argument has by itself, and loses it again in the options of `app`.
std::vector<std::string> protected_arguments(int argc, char** argv);
std::string restored_argument(std::string argument);
void restore_arguments(CLI::App& app);

}  // namespace reprise::cli
