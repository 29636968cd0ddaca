// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/slip_motion.h"

#include "signorini/contact/friction/facet_turn.h"

namespace signorini::contact
{
template <int dim, typename Number>
auto SlipMotion<dim, Number>::carry(const PointSlip<dim> &slip) const -> Vector
{
  if (!slip.is_touching())
    return Vector::Zero();
  const Vector elastic = turn * slip.elastic.template cast<Number>(),
               from = turn * slip.normal.template cast<Number>();
  return turn_to_plane<dim, Number>(elastic, from, normal);
}

template <int dim, typename Number>
auto SlipMotion<dim, Number>::find_increment() const -> Vector
{
  const Vector moved = find_motion();
  const Number along_normal = normal.dot(moved);
  return moved - along_normal * normal;
}

template <int dim, typename Number>
Number SlipMotion<dim, Number>::find_share(const Number &overlap) const
{
  const Number approach = -normal.dot(find_motion());
  return overlap > 0. && approach > overlap ? Number(overlap / approach) : Number(1.);
}

template struct SlipMotion<2>;
template struct SlipMotion<3>;
template struct SlipMotion<2, Differentiable<2>>;
template struct SlipMotion<3, Differentiable<3>>;
} // namespace signorini::contact
