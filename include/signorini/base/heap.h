// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>

namespace signorini
{
/// Memory that this process has allocated and not freed [bytes]; 0 where the C library does not tell, as with
/// sanitizers.
std::size_t heap_in_use();
} // namespace signorini
