// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/local_domain.h"

namespace signorini::contact
{
template <>
LocalPlace<2> find_local_place(const FacetElement<2> &, const LocalPoint<2> &xi, const double tolerance)
{
  LocalPlace<2> place;
  const bool is_at_end = xi[0] >= 1. - tolerance;
  if (is_at_end || xi[0] <= tolerance)
    place.n_free = 0;
  if (is_at_end)
    place.directions(0, 0) = -1.;
  return place;
}

template <>
LocalPlace<3> find_local_place(const FacetElement<3> &element, const LocalPoint<3> &xi,
                               const double tolerance)
{
  LocalPlace<3> place;
  const unsigned int n_sides = n_local_corners(element.type);
  const auto side = [&](const unsigned int k) -> LocalPoint<3>
  { return local_corner(element.type, k + 1) - local_corner(element.type, k); };
  const auto lies_on = [&](const unsigned int k)
  { return cross(side(k), xi - local_corner(element.type, k)) <= tolerance; };
  for (unsigned int k = 0; k < n_sides; ++k)
  {
    if (!lies_on(k))
      continue;
    const LocalPoint<3> along = side(k);
    place.n_free = 1;
    place.directions << along[0], -along[1], along[1], along[0];
    const unsigned int before = k + n_sides - 1;
    if (lies_on(before))
    {
      place.n_free = 0;
      place.directions.col(1) = -side(before);
      break;
    }
  }
  return place;
}
} // namespace signorini::contact
