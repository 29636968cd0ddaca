// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/command_line.h"

#include "signorini/base/exceptions.h"
#include "signorini/base/version.h"
#include "signorini/parameters/print_parameters.h"
#include "signorini/parameters/strings.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace signorini
{
namespace
{
void add_options(CLI::App &app, CommandLine &command_line)
{
  app.add_option("file", command_line.file, "Parameter file, or - for standard input")->type_name("FILE.prm");
  app.add_flag("--validate", command_line.validate, "Check everything and print the plan, but run nothing");
  app.add_option("--parameters", command_line.parameters_format,
                 "Print all parameters, as in --parameters=md, and leave; prm if no format is given")
      ->type_name("prm|json|md");
  app.add_option("--set", command_line.overrides, "Override an entry of the file; may be repeated")
      ->type_name("SECTION/KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--output", command_line.output, "Directory of the results")->type_name("DIR");
  app.add_flag("--resume", command_line.resume,
               "Go on from the last checkpoint; make those runs of a study that are not finished");
  app.add_flag("--quiet", command_line.quiet, "Print errors only");
  app.set_version_flag("--version", "signorini " + program_version());
}

/// Without this, `--parameters FILE` would take the file for the format. CLI11 wants the last argument first.
std::vector<std::string> reversed_arguments(const int argc, const char *const *argv)
{
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  std::replace(arguments.begin(), arguments.end(), std::string("--parameters"),
               std::string("--parameters=prm"));
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

[[noreturn]] void reject_unknown(const std::vector<std::string> &unknown)
{
  static const std::vector<std::string> options{"--validate", "--parameters", "--set",     "--output",
                                                "--resume",   "--quiet",      "--version", "--help"};
  const bool is_option = unknown.front().compare(0, 1, "-") == 0;
  const std::string name = unknown.front().substr(0, unknown.front().find('='));
  throw InputError(
      Complaint(is_option ? "there is no option '" + name + "'" : "more than one parameter file is given")
          .at("command line")
          .found("'" + unknown.front() + "'")
          .expected(is_option ? "one of " + join(options, ", ") : "one file")
          .did_you_mean(is_option ? nearest_name(name, options) : "")
          .advise("'signorini --help' explains the options"));
}
} // namespace

CommandLine parse_command_line(const int argc, const char *const *argv)
{
  CommandLine command_line;
  CLI::App app("Finite elements with contact: runs a parameter file.", "signorini");
  add_options(app, command_line);
  app.allow_extras();
  try
  {
    app.parse(reversed_arguments(argc, argv));
  }
  catch (const CLI::CallForHelp &)
  {
    command_line.answer = app.help();
    return command_line;
  }
  catch (const CLI::CallForVersion &version)
  {
    command_line.answer = std::string(version.what()) + "\n";
    return command_line;
  }
  catch (const CLI::ParseError &error)
  {
    throw InputError(
        Complaint(error.what()).at("command line").advise("'signorini --help' explains the options"));
  }
  if (!app.remaining().empty())
    reject_unknown(app.remaining());
  if (command_line.parameters_format)
    parameters_format(*command_line.parameters_format);
  else if (command_line.file.empty())
    throw InputError(
        Complaint("no parameter file is given").at("command line").advise("signorini [options] FILE.prm"));
  return command_line;
}

ParameterText read_parameter_text(const CommandLine &command_line)
{
  ParameterText text = read_parameter_text(command_line.file);
  for (const std::string &override_text : command_line.overrides)
    apply_override(text, override_text);
  if (command_line.output)
    apply_override(text, "Output/Directory=" + *command_line.output);
  return text;
}
} // namespace signorini
