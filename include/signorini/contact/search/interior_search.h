// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_box.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace signorini::contact
{
/// A point that lies in a body.
template <int dim>
struct InteriorPoint
{
  unsigned int body = 0;
  unsigned int facet = 0; ///< of that body, the nearest one
  double depth = 0.;      ///< > 0 [m]
  SpatialVector<dim> foot = SpatialVector<dim>::Zero();
};

/// Finds the bodies that hold a point, however deep: meant for single checks, not for every step. A query
/// costs the logarithm of the number of facets, and a few more facets the deeper the point lies.
template <int dim>
class InteriorSearch
{
public:
  using Positions = std::vector<SpatialVector<dim>>;

  /// `surface` and `positions` must outlive this object; the surface of every body must be closed.
  InteriorSearch(const ContactSurface<dim> &surface, const Positions &positions);
  ~InteriorSearch();

  /// Of the bodies that `is_considered`, the one in which the point lies deepest.
  std::optional<InteriorPoint<dim>>
  find_deepest(const SpatialVector<dim> &x, const std::function<bool(unsigned int)> &is_considered) const;

private:
  struct Trees;

  std::optional<InteriorPoint<dim>> find_in_body(const SpatialVector<dim> &x, unsigned int body) const;

  const ContactSurface<dim> &surface;
  const Positions &positions;
  std::unique_ptr<const Trees> trees;
};
} // namespace signorini::contact
