// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace signorini
{
/// Gives freed memory back and starts the process's peak of memory anew from what is in use, so that the next
/// run reports its own. Returns false where the kernel does not allow it: the peak is then that of all runs
/// so far. This rank only.
bool reset_memory_peak();
} // namespace signorini
