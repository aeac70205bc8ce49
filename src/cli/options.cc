#include "cli/options.h"

#include "reprise/error.h"
#include "reprise/query/take_reading.h"

namespace reprise::cli {

CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& target,
                      const std::string& description, const std::string& type) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target](const std::string& text) {
            if (text.empty()) refuse_value(name, text, "a text");
            target = text;
          },
          description)
      ->type_name(type);
}

CLI::Option* add_path(CLI::App& app, const std::string& name, std::filesystem::path& target,
                      const std::string& description, const std::string& type) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target](const std::string& text) {
            if (text.empty()) refuse_value(name, text, "a path");
            target = text;
          },
          description)
      ->type_name(type);
}

CLI::Option* add_input_file(CLI::App& app, const std::string& name, std::filesystem::path& target,
                            const std::string& description) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target](const std::string& text) {
            if (text.empty()) refuse_value(name, text, "a path");
            target = text == "-" ? stdin_path : text;
          },
          description)
      ->type_name("FILE");
}

CLI::Option* add_archive(CLI::App& app, std::filesystem::path& target) {
  return app
      .add_option_function<std::string>(
          "ARCHIVE",
          [&target](const std::string& text) {
            if (text.empty()) refuse_value("ARCHIVE", text, "a path");
            if (text == "-") {
              throw Error(ErrorCode::usage,
                          "an archive cannot come from stdin or go to stdout: it is read and "
                          "written in places");
            }
            target = text;
          },
          "The archive, by habit *.rpz")
      ->type_name("FILE")
      ->required();
}

CLI::Option* add_many(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                      const std::string& description) {
  return app
      .add_option_function<std::vector<std::string>>(
          name,
          [name, &target](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              if (text.empty()) refuse_value(name, text, "texts that are not empty");
            }
            target = texts;
          },
          description)
      ->type_name("");
}

void add_console_options(CLI::App& app, ConsoleOptions& options) {
  app.add_flag("-q,--quiet", options.quiet, "No messages and no progress on stderr");
  app.add_flag("-v,--verbose", options.verbose, "More messages on stderr");
  app.add_flag("--json", options.json, "The result as one JSON document on stdout");
  app.add_option_function<std::string>(
         "--color",
         [&options](const std::string& text) {
           if (text != "auto" && text != "never") refuse_value("--color", text, "auto or never");
           options.color = text;
         },
         "auto (default; only on a terminal) or never; NO_COLOR means never")
      ->type_name("WHEN");
}

void add_read_options(CLI::App& app, ReadOptions& options) {
  app.add_option_function<std::vector<std::string>>(
         "--asf",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             if (text.empty() || text == "-") refuse_value("--asf", text, "a path");
             options.asf.emplace_back(text);
           }
         },
         "A skeleton of AMC files, else the one beside each; of several, each AMC has that of its "
         "name")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_number(app, "--unit-mm", options.bvh_millimetres_per_unit,
             1 / ReadingLimits::greatest_unit_mm, ReadingLimits::greatest_unit_mm,
             "Millimetres in a length unit of BVH files (default: guessed from the body, else 10)");
  app.add_option_function<std::string>(
         "--up",
         [&options](const std::string& text) {
           options.up = find_up_axis(text);
           if (!options.up) refuse_value("--up", text, "x, y, z, -x, -y or -z");
         },
         "The axis that points up: x, y, z, -x, -y or -z (default: found from the motion)")
      ->type_name("AXIS");
  add_number(app, "--fps", options.frame_rate, 1 / ReadingLimits::greatest_frame_rate,
             ReadingLimits::greatest_frame_rate,
             "Frames a second, whatever the files say (else an AMC that says nothing has 120)");
  app.add_flag("--partial", options.partial, "Take a recording that was cut off as far as it goes");
}

void add_examples(CLI::App& app, const std::vector<std::string>& lines) {
  std::string text = "Example:";
  for (const std::string& line : lines) text += "\n  " + line;
  app.footer(text);
}

}  // namespace reprise::cli
