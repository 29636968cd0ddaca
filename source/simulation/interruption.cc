// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/interruption.h"

#include <csignal>

namespace signorini
{
namespace
{
volatile std::sig_atomic_t received = 0;

void note(int signal)
{
  received = signal;
}
} // namespace

void watch_for_interruption()
{
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string interruption(const MPI_Comm &communicator)
{
  int signal = received;
  MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, communicator);
  return signal == 0 ? "" : signal == SIGINT ? "SIGINT" : "SIGTERM";
}
} // namespace signorini
