// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/input_file.h"

#include "signorini/base/exceptions.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace signorini
{
namespace
{
constexpr std::size_t largest_size = std::size_t(16) << 20;

/// One byte more than is allowed tells a stream that is too long; one that never ends is left there.
std::string read_stream(std::istream &stream)
{
  std::string content;
  std::string block(1 << 16, '\0');
  while (content.size() <= largest_size && (stream.read(block.data(), block.size()) || stream.gcount() > 0))
    content.append(block, 0, stream.gcount());
  return content;
}

void check_size(const std::string &content, const std::string &place)
{
  if (content.size() > largest_size)
    throw InputError(Complaint("this is too large to be a parameter file")
                         .at(place)
                         .expected(fmt::format("at most {} MB", largest_size >> 20))
                         .advise("give the name of a parameter file"));
}
} // namespace

std::string read_input_file(const std::string &file)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  const auto cannot_be_read = [&file]()
  {
    return FileError(Complaint(fmt::format("the parameter file '{}' cannot be read", file))
                         .advise("give the name of an existing parameter file, or - for standard input"));
  };
  const fs::file_status status = fs::status(file, ignored);
  if (!fs::exists(status) || fs::is_directory(status))
    throw cannot_be_read();
  if (!fs::is_regular_file(status))
    throw InputError(Complaint("this is no regular file, but a device, pipe or socket")
                         .at(file)
                         .expected("a regular file, or - for standard input")
                         .advise("write its content to a file, or to standard input with - for the name"));
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw cannot_be_read();
  const std::string content = read_stream(stream);
  if (stream.bad())
    throw cannot_be_read();
  check_size(content, file);
  return content;
}

std::string read_standard_input()
{
  std::string content;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    content = read_stream(std::cin);
  content = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, content, 0);
  check_size(content, "standard input");
  return content;
}
} // namespace signorini
