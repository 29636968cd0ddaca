// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/run_file.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/checkpoint.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/simulation/run.h"
#include "signorini/study/study.h"

namespace signorini
{
void run_file(const CommandLine &command_line, const MPI_Comm &communicator)
{
  const ParameterText text = read_parameter_text(command_line);
  const Parameters parameters = read_parameters(text);
  if (parameters.study)
  {
    Study study(command_line, text, parameters, communicator);
    command_line.validate ? study.print_plan() : study.run();
    return;
  }
  const std::string &directory = parameters.output.directory;
  if (command_line.resume && !Checkpoint(directory, communicator).exists())
    throw FileError(Complaint("there is no checkpoint to resume from")
                        .at(directory + "/checkpoint")
                        .expected("what a run with 'subsection Checkpoint' writes there")
                        .advise("leave out --resume, or name the output directory of the run by --output"));
  const Screen screen = command_line.quiet ? Screen::nothing : Screen::all;
  if (command_line.validate)
    print_plan(text, parameters, communicator, screen);
  else
    run(text, parameters, command_line.overrides, communicator, screen,
        command_line.resume ? Start::at_checkpoint : Start::anew);
}
} // namespace signorini
