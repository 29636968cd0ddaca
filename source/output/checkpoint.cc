// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/checkpoint.h"

#include "signorini/base/collective_error.h"
#include "signorini/base/exceptions.h"
#include "signorini/base/version.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

namespace signorini
{
namespace
{
/// What a file begins with.
struct Header
{
  std::array<char, 16> version{};
  std::uint64_t number = 0; ///< of the checkpoint, the same in the files of all ranks
  std::uint64_t size = 0;   ///< of the content [bytes]
  std::uint32_t n_ranks = 0;
  std::uint32_t checksum = 0; ///< of the content
};

Header make_header()
{
  Header header;
  program_version().copy(header.version.data(), header.version.size() - 1);
  return header;
}

std::uint32_t checksum_of(const std::string &content)
{
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef *>(content.data()), content.size()));
}

[[noreturn]] void complain_of_writing(const std::string &path)
{
  throw FileError(
      Complaint(fmt::format("cannot write the checkpoint: {}", std::strerror(errno)))
          .at(path)
          .advise("make room; 'signorini --resume' goes on from the checkpoint before, if there is "
                  "one"));
}

/// Writes a file, or over the first bytes of one, and waits until it is on the disk.
void write_synced(const std::string &path, int flags, const std::string &bytes)
{
  constexpr unsigned int rights = 0644;
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, rights);
  if (file < 0)
    complain_of_writing(path);
  std::size_t n_written = 0;
  while (n_written < bytes.size())
  {
    const ssize_t n = ::write(file, bytes.data() + n_written, bytes.size() - n_written);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      break;
    n_written += static_cast<std::size_t>(n);
  }
  const bool is_good = n_written == bytes.size() && fsync(file) == 0;
  const int fault = errno;
  close(file);
  errno = fault;
  if (!is_good)
    complain_of_writing(path);
}

/// Waits until the names in a folder are on the disk; file systems that cannot do that need not.
void sync_folder(const std::string &path)
{
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0)
    return;
  fsync(folder);
  close(folder);
}
} // namespace

Checkpoint::Checkpoint(const std::string &output_directory, const MPI_Comm &mpi_communicator)
    : folder(output_directory + "/checkpoint"), communicator(mpi_communicator)
{
}

std::string Checkpoint::file_of(unsigned int slot) const
{
  return fmt::format("{}/{}/rank_{}", folder, slot, dealii::Utilities::MPI::this_mpi_process(communicator));
}

bool Checkpoint::exists() const
{
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  std::error_code ignored;
  return dealii::Utilities::MPI::broadcast(communicator,
                                           is_first && std::filesystem::exists(folder + "/last", ignored), 0);
}

void Checkpoint::write(const std::string &content)
{
  const unsigned int slot = 1 - last_slot;
  Header header = make_header();
  header.number = number + 1;
  header.size = content.size();
  header.n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  header.checksum = checksum_of(content);
  throw_together(communicator,
                 [&]()
                 {
                   const std::string slot_folder = fmt::format("{}/{}", folder, slot);
                   std::error_code failure;
                   std::filesystem::create_directories(slot_folder, failure);
                   write_synced(file_of(slot), O_TRUNC,
                                std::string(reinterpret_cast<const char *>(&header), sizeof(header)) +
                                    content);
                   sync_folder(slot_folder);
                 });
  throw_together(communicator,
                 [&]()
                 {
                   if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
                     point_to(slot);
                 });
  last_slot = slot;
  ++number;
}

void Checkpoint::point_to(unsigned int slot) const
{
  // One byte over the one before: that needs no room on the disk, and no instant is without a pointer.
  write_synced(folder + "/last", 0, std::to_string(slot));
  sync_folder(folder);
}

std::string Checkpoint::read_slot(unsigned int slot, std::string &content)
{
  const std::string path = file_of(slot);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  std::string fault;
  Header header;
  std::ifstream file(path, std::ios::binary);
  if (!file || !file.read(reinterpret_cast<char *>(&header), sizeof(header)))
    fault = "cannot be read";
  else if (header.version != make_header().version)
    fault = "is not a checkpoint of this version of the program";
  else
  {
    std::error_code failure;
    const std::uint64_t size = std::filesystem::file_size(path, failure) - sizeof(header);
    if (failure || size != header.size)
      fault = fmt::format("has {} bytes of {}", size, header.size);
    else
    {
      content.resize(size);
      file.read(content.data(), static_cast<std::streamsize>(size));
      if (!file || checksum_of(content) != header.checksum)
        fault = "is damaged: its checksum is another";
    }
  }
  if (!fault.empty())
    fault = path + " " + fault;
  const auto faults = dealii::Utilities::MPI::all_gather(communicator, fault);
  const unsigned int n_ranks_of_file = dealii::Utilities::MPI::broadcast(communicator, header.n_ranks, 0);
  if (faults[0].empty() && n_ranks_of_file != n_ranks)
    throw InputError(Complaint("a checkpoint can only be read by as many ranks as wrote it")
                         .at(folder)
                         .found(fmt::format("{} ranks", n_ranks))
                         .expected(fmt::format("{}", n_ranks_of_file))
                         .advise(fmt::format("start the program by 'mpirun -np {}'", n_ranks_of_file)));
  for (const std::string &of_rank : faults)
    if (!of_rank.empty())
      return of_rank;
  const auto numbers = dealii::Utilities::MPI::min_max_avg(static_cast<double>(header.number), communicator);
  if (numbers.min != numbers.max)
    return fmt::format("{}/{} has files of different times", folder, slot);
  number = header.number;
  return "";
}

Checkpoint::Found Checkpoint::read()
{
  unsigned int newest = 0;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    newest = std::ifstream(folder + "/last").get() == '1' ? 1 : 0;
  newest = dealii::Utilities::MPI::broadcast(communicator, newest, 0);
  Found found;
  for (const unsigned int slot : {newest, 1 - newest})
  {
    const std::string fault = read_slot(slot, found.content);
    if (fault.empty())
    {
      found.slot = fmt::format("{}/{}", folder, slot);
      last_slot = slot;
      return found;
    }
    found.faults.push_back(fault);
  }
  throw FileError(Complaint("there is no good checkpoint to resume from")
                      .at(folder)
                      .found(fmt::format("{}", fmt::join(found.faults, "; ")))
                      .advise("run again from the start, without --resume"));
}
} // namespace signorini
