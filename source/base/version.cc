// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/version.h"

namespace signorini
{
std::string program_version()
{
  return SIGNORINI_VERSION;
}
} // namespace signorini
