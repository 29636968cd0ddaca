// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/run_file.h"

#include "signorini/base/exceptions.h"
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
  if (command_line.resume)
    throw InputError(Complaint("there is nothing to resume: the file has no 'Study'")
                         .at(display_name(text.file))
                         .found("--resume")
                         .expected("a file with 'subsection Study', whose finished runs are not made again")
                         .advise("leave out --resume"));
  const Screen screen = command_line.quiet ? Screen::nothing : Screen::all;
  if (command_line.validate)
    print_plan(text, parameters, communicator, screen);
  else
    run(text, parameters, command_line.overrides, communicator, screen);
}
} // namespace signorini
