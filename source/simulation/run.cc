// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/run.h"

#include "signorini/simulation/run_directory.h"
#include "signorini/simulation/simulation.h"
#include "signorini/simulation/size_estimate.h"

namespace signorini
{
namespace
{
/// Builds the simulation of a text, in its dimension, and calls `use` with it.
template <typename Use>
void build(const ParameterText &text, const Parameters &parameters, const MPI_Comm &communicator,
           const Screen screen, const Use &use)
{
  check_size(text, parameters, communicator);
  const bool is_quiet = screen == Screen::nothing;
  if (parameters.dimension == 2)
    use(Simulation<2>(text, parameters, communicator, is_quiet));
  else
    use(Simulation<3>(text, parameters, communicator, is_quiet));
}
} // namespace

void run(const ParameterText &text, const Parameters &parameters, const std::vector<std::string> &overrides,
         const MPI_Comm &communicator, const Screen screen, const Start start)
{
  const std::string &directory = parameters.output.directory;
  build(text, parameters, communicator, screen,
        [&](auto &&simulation)
        {
          const auto lock = lock_directory(directory, communicator);
          if (start == Start::at_checkpoint)
            simulation.resume();
          else
            clear_directory(text, overrides, directory, communicator);
          write_parameters(text, directory, communicator);
          simulation.run();
        });
}

void print_plan(const ParameterText &text, const Parameters &parameters, const MPI_Comm &communicator,
                const Screen screen)
{
  build(text, parameters, communicator, screen, [](auto &&simulation) { simulation.print_plan(); });
}
} // namespace signorini
