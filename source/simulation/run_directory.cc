// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/run_directory.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/earlier_output.h"
#include "signorini/parameters/print_parameters.h"

#include <deal.II/base/mpi.h>

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
} // namespace

void on_first_rank(const MPI_Comm &communicator, const std::function<void()> &call)
{
  std::string fault;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    try
    {
      call();
    }
    catch (const FileError &error)
    {
      fault = error.what();
    }
  fault = dealii::Utilities::MPI::broadcast(communicator, fault, 0);
  if (!fault.empty())
    throw FileError(fault);
}

std::unique_ptr<OutputLock> lock_directory(const std::string &directory, const MPI_Comm &communicator)
{
  std::unique_ptr<OutputLock> lock;
  on_first_rank(communicator, [&] { lock = std::make_unique<OutputLock>(directory); });
  return lock;
}

void clear_directory(const ParameterText &text, const std::vector<std::string> &overrides,
                     const std::string &directory, const MPI_Comm &communicator)
{
  const std::string used = directory + "/parameters.prm";
  on_first_rank(
      communicator,
      [&]
      {
        // A run may be repeated from what it wrote, which then stays as it is; overrides would be
        // lost that way.
        if (!overrides.empty() && is_input(text, used))
          throw FileError(
              Complaint("the input lies where the parameters of the run, with its overrides, are written")
                  .at(used)
                  .found("--set '" + overrides.front() + "'")
                  .expected("no --set, or an output directory without the input")
                  .advise("choose another directory by --output"));
        remove_earlier_output(directory);
      });
}

void write_parameters(const ParameterText &text, const std::string &directory, const MPI_Comm &communicator)
{
  const std::string used = directory + "/parameters.prm";
  on_first_rank(communicator,
                [&]
                {
                  if (is_input(text, used))
                    return;
                  std::ofstream file(used);
                  write_parameters_used(text, file);
                  if (!file.flush())
                    throw FileError("cannot write '" + used + "'");
                });
}
} // namespace signorini
