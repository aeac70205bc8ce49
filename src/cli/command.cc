#include "cli/command.h"

#include "cli/compact_command.h"
#include "cli/compare_command.h"
#include "cli/extract_command.h"
#include "cli/info_command.h"
#include "cli/ingest_command.h"
#include "cli/list_command.h"
#include "cli/plot_command.h"
#include "cli/remove_command.h"
#include "cli/repeats_command.h"
#include "cli/search_command.h"
#include "cli/stats_command.h"
#include "cli/synth_command.h"
#include "cli/verify_command.h"

namespace reprise::cli {

std::vector<std::unique_ptr<Command>> all_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<IngestCommand>());
  commands.push_back(std::make_unique<ListCommand>());
  commands.push_back(std::make_unique<InfoCommand>());
  commands.push_back(std::make_unique<ExtractCommand>());
  commands.push_back(std::make_unique<SearchCommand>());
  commands.push_back(std::make_unique<RepeatsCommand>());
  commands.push_back(std::make_unique<PlotCommand>());
  commands.push_back(std::make_unique<StatsCommand>());
  commands.push_back(std::make_unique<CompareCommand>());
  commands.push_back(std::make_unique<VerifyCommand>());
  commands.push_back(std::make_unique<RemoveCommand>());
  commands.push_back(std::make_unique<CompactCommand>());
  commands.push_back(std::make_unique<SynthCommand>());
  return commands;
}

}  // namespace reprise::cli
