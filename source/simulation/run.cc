// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/run.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/earlier_output.h"
#include "signorini/parameters/print_parameters.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/simulation/simulation.h"
#include "signorini/simulation/size_estimate.h"

#include <filesystem>
#include <fstream>

namespace signorini
{
namespace
{
void write_used_parameters(const ParameterText &text, const std::string &directory)
{
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  std::ofstream file(directory + "/parameters.prm");
  write_parameters_used(text, file);
  if (!file.flush())
    throw FileError("cannot write '" + directory + "/parameters.prm'");
}

template <int dim>
void run(const CommandLine &command_line, const ParameterText &text, const Parameters &parameters,
         const MPI_Comm &communicator)
{
  Simulation<dim> simulation(parameters, command_line.file, communicator, command_line.quiet);
  if (command_line.validate)
  {
    simulation.print_plan();
    return;
  }
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    remove_earlier_output(parameters.output.directory);
    write_used_parameters(text, parameters.output.directory);
  }
  MPI_Barrier(communicator);
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
