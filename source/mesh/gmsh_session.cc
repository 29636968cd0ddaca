// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/gmsh_session.h"

#include <gmsh.h>

namespace signorini
{
GmshSession::GmshSession()
{
  gmsh::initialize(0, nullptr, false);
  for (const char *const silent : {"General.Terminal", "General.Verbosity"})
    gmsh::option::setNumber(silent, 0.);
  for (const char *const one : {"General.NumThreads", "Mesh.MaxNumThreads1D", "Mesh.MaxNumThreads2D",
                                "Mesh.MaxNumThreads3D", "Mesh.RandomSeed"})
    gmsh::option::setNumber(one, 1.);
}

GmshSession::~GmshSession()
{
  gmsh::finalize();
}

void GmshSession::run(const Complaint &complaint, const std::function<void()> &work) const
{
  const auto give_up = [&complaint](const std::string &reason)
  { throw InputError(Complaint(complaint).found("Gmsh says: " + reason)); };
  try
  {
    work();
  }
  catch (const ProgramError &)
  {
    throw;
  }
  catch (const std::string &reason)
  {
    give_up(reason);
  }
  catch (const std::exception &reason)
  {
    give_up(reason.what());
  }
  catch (const int code) // the C interface's
  {
    std::string reason;
    gmsh::logger::getLastError(reason);
    give_up(reason.empty() ? "error " + std::to_string(code) : reason);
  }
}
} // namespace signorini
