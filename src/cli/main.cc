// The command `reprise`.
#include "cli/command_line.h"

int main(int argc, char** argv) { return reprise::cli::run_command_line(argc, argv); }
