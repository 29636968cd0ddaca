// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/output_lock.h"

#include "signorini/base/exceptions.h"

#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace signorini
{
OutputLock::OutputLock(const std::string &directory)
{
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  descriptor = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    throw FileError("cannot open the output directory '" + directory + "'");
  // File systems without locks answer with another error; a run there goes on unprotected.
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
  {
    close(descriptor);
    throw FileError(Complaint("the output directory is in use by another run")
                        .at(directory)
                        .advise("wait for the end of that run, or choose another directory by --output"));
  }
}

OutputLock::~OutputLock()
{
  close(descriptor);
}
} // namespace signorini
