// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace signorini
{
/// The folder checkpoint/ of an output directory, from which a run can go on that was stopped: two slots, 0
/// and 1, with a file of every rank, written in turn, and the file `last`, which names the slot that was last
/// written whole. Each file begins with its length and checksum, and is looked at only where they are right.
class Checkpoint
{
public:
  /// What was read back.
  struct Found
  {
    std::string content;             ///< of this rank
    std::string slot;                ///< its folder
    std::vector<std::string> faults; ///< of a newer slot that could not be used
  };

  Checkpoint(const std::string &output_directory, const MPI_Comm &communicator);

  /// Whether there is one, good or not (collective).
  bool exists() const;

  /// Writes what each rank has to keep into the slot that is not the last good one, waits until it is on the
  /// disk, and only then points to it (collective). Throws FileError, after which the last good one still is.
  void write(const std::string &content);

  /// What was last written; the one before if that has been damaged (collective). Throws FileError if there
  /// is none or both are damaged, InputError if it was written by another number of ranks.
  Found read();

private:
  /// This rank's file in a slot.
  std::string file_of(unsigned int slot) const;
  void point_to(unsigned int slot) const;
  /// What is wrong with a slot's file of some rank, empty if nothing is; else its content (collective).
  std::string read_slot(unsigned int slot, std::string &content);

  std::string folder;
  MPI_Comm communicator;
  unsigned int last_slot = 1; ///< that was last written or read
  unsigned long number = 0;   ///< of checkpoints written until then
};
} // namespace signorini
