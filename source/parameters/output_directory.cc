// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/output_directory.h"

#include "signorini/base/exceptions.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace signorini
{
namespace
{
namespace fs = std::filesystem;

/// The directory and its parents that do not exist, innermost first.
std::vector<fs::path> missing_directories(const fs::path &directory)
{
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path path = directory; !path.empty() && !fs::exists(path, ignored); path = path.parent_path())
    missing.push_back(path);
  return missing;
}

/// Why a file cannot be written into the directory; empty if it can.
std::string find_fault(const fs::path &directory)
{
  const fs::path probe = directory / ".signorini_probe";
  {
    std::ofstream stream(probe);
    stream << "can a file be written here?" << std::flush;
    if (!stream)
      return "a file cannot be written there";
  }
  std::error_code ignored;
  fs::remove(probe, ignored);
  return "";
}

std::string try_directory(const std::string &name)
{
  std::error_code error;
  const fs::path directory = fs::absolute(name).lexically_normal();
  const std::vector<fs::path> missing = missing_directories(directory);
  fs::create_directories(directory, error);
  std::string fault = error ? error.message() : "";
  if (fault.empty() && !fs::is_directory(directory, error))
    fault = "it is not a directory";
  if (fault.empty())
    fault = find_fault(directory);
  for (const fs::path &made : missing)
    fs::remove(made, error);
  return fault;
}
} // namespace

void check_output_directory(const std::string &directory, const std::string &where)
{
  std::string fault;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    fault = try_directory(directory);
  fault = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, fault, 0);
  if (!fault.empty())
    throw FileError(Complaint(fmt::format("the output directory cannot be used: {}", fault))
                        .at(where)
                        .found("Output/Directory = " + directory)
                        .expected("a directory that can be made and written to")
                        .advise("choose another one in 'Output/Directory' or by --output"));
}
} // namespace signorini
