// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/run.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/earlier_output.h"
#include "signorini/output/output_lock.h"
#include "signorini/parameters/print_parameters.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/simulation/simulation.h"
#include "signorini/simulation/size_estimate.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace signorini
{
namespace
{
/// Whether the parameters used would be written over the file, or a file included by it, that they come from.
bool is_input(const ParameterText &text, const std::string &used)
{
  const auto is_same = [&used](const std::string &file)
  {
    std::error_code ignored;
    return std::filesystem::equivalent(file == "-" ? "/dev/stdin" : file, used, ignored);
  };
  return is_same(text.file) || std::any_of(text.entries.begin(), text.entries.end(),
                                           [&](const ParameterEntry &entry) { return is_same(entry.file); });
}

/// A run may be repeated from what it wrote, which then stays as it is; overrides would be lost that way.
void start_directory(const CommandLine &command_line, const ParameterText &text, const std::string &directory)
{
  const std::string used = directory + "/parameters.prm";
  const bool is_repetition = is_input(text, used);
  if (is_repetition && !command_line.overrides.empty())
    throw FileError(
        Complaint("the input lies where the parameters of the run, with its overrides, are written")
            .at(used)
            .found("--set '" + command_line.overrides.front() + "'")
            .expected("no --set, or an output directory without the input")
            .advise("choose another directory by --output"));
  remove_earlier_output(directory);
  if (is_repetition)
    return;
  std::ofstream file(used);
  write_parameters_used(text, file);
  if (!file.flush())
    throw FileError("cannot write '" + used + "'");
}

/// What is returned keeps other runs out. Rank 0 does it, all ranks throw; the others get nothing.
std::unique_ptr<OutputLock> prepare_directory(const CommandLine &command_line, const ParameterText &text,
                                              const std::string &directory, const MPI_Comm &communicator)
{
  std::unique_ptr<OutputLock> lock;
  std::string fault;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    try
    {
      lock = std::make_unique<OutputLock>(directory);
      start_directory(command_line, text, directory);
    }
    catch (const FileError &error)
    {
      fault = error.what();
    }
  fault = dealii::Utilities::MPI::broadcast(communicator, fault, 0);
  if (!fault.empty())
    throw FileError(fault);
  return lock;
}

template <int dim>
void run(const CommandLine &command_line, const ParameterText &text, const Parameters &parameters,
         const MPI_Comm &communicator)
{
  Simulation<dim> simulation(text, parameters, communicator, command_line.quiet);
  if (command_line.validate)
  {
    simulation.print_plan();
    return;
  }
  const auto lock = prepare_directory(command_line, text, parameters.output.directory, communicator);
  simulation.run();
}
} // namespace

void run(const CommandLine &command_line, const MPI_Comm &communicator)
{
  const ParameterText text = read_parameter_text(command_line);
  const Parameters parameters = read_parameters(text);
  check_size(text, parameters, communicator);
  if (parameters.dimension == 2)
    run<2>(command_line, text, parameters, communicator);
  else
    run<3>(command_line, text, parameters, communicator);
}
} // namespace signorini
