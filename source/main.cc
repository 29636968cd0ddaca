// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/exceptions.h"
#include "signorini/parameters/output_directory.h"
#include "signorini/parameters/print_parameters.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/simulation/command_line.h"
#include "signorini/study/run_file.h"

#include <deal.II/base/mpi.h>

#include <iostream>

int main(int argc, char **argv)
{
  using namespace signorini;
  int n_for_libraries = 1; // PETSc would look for its own options among ours and complain of what is left
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_for_libraries, argv, 1);
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  try
  {
    const CommandLine command_line = parse_command_line(argc, argv);
    if (is_first)
      std::cout << command_line.answer;
    if (!command_line.answer.empty())
      return 0;
    if (command_line.parameters_format)
    {
      if (is_first)
        print_parameters(parameters_format(*command_line.parameters_format), std::cout);
      return 0;
    }
    run_file(command_line, MPI_COMM_WORLD);
    return 0;
  }
  catch (const ProgramError &error)
  {
    if (is_first)
      std::cerr << "signorini: " << error.what() << std::endl;
    return error.exit_code();
  }
  catch (const std::exception &error)
  {
    std::cerr << "signorini: internal error: " << error.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}
