// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/collective_error.h"

#include "signorini/base/exceptions.h"

#include <deal.II/base/mpi.h>

namespace signorini
{
namespace
{
[[noreturn]] void throw_by_code(int exit_code, const Complaint &complaint)
{
  if (exit_code == NumericalError("").exit_code())
    throw NumericalError(complaint);
  if (exit_code == FileError("").exit_code())
    throw FileError(complaint);
  throw InputError(complaint);
}
} // namespace

void throw_together(const MPI_Comm &communicator, const std::function<void()> &call)
{
  std::vector<std::string> parts;
  try
  {
    call();
  }
  catch (const ProgramError &error)
  {
    const Complaint &complaint = error.complaint();
    parts = {complaint.what,
             complaint.where,
             complaint.value,
             complaint.allowed,
             complaint.nearest,
             complaint.next_step,
             std::to_string(error.exit_code())};
  }
  if (dealii::Utilities::MPI::max(parts.size(), communicator) == 0)
    return;
  for (const std::vector<std::string> &of_rank : dealii::Utilities::MPI::all_gather(communicator, parts))
    if (!of_rank.empty())
      throw_by_code(std::stoi(of_rank[6]), Complaint(of_rank[0])
                                               .at(of_rank[1])
                                               .found(of_rank[2])
                                               .expected(of_rank[3])
                                               .did_you_mean(of_rank[4])
                                               .advise(of_rank[5]));
}
} // namespace signorini
