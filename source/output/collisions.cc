// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/collisions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <map>

namespace signorini
{
namespace
{
Eigen::Map<const Eigen::Vector3d> to_vector(const Triple &triple)
{
  return Eigen::Map<const Eigen::Vector3d>(triple.data());
}

/// What a row has of `one` less that of `other`.
Eigen::Vector3d difference(const HistoryRow &row, const Collision &collision, Triple BodyRecord::*member)
{
  return to_vector(row.bodies[collision.one].*member) - to_vector(row.bodies[collision.other].*member);
}

/// How contact pushes one of the two.
struct Push
{
  Eigen::Matrix3d squared_forces = Eigen::Matrix3d::Zero(); ///< Σ F⊗F over the rows
  double largest_speed = 0.;

  void add(const BodyRecord &body)
  {
    const auto force = to_vector(body.contact_force);
    squared_forces += force * force.transpose();
    largest_speed = std::max(largest_speed, to_vector(body.velocity).norm());
  }

  /// Of a body that is held nothing.
  Eigen::Matrix3d weighted() const { return largest_speed * largest_speed * squared_forces; }
};

/// The touches of a pair that are one collision.
class Touches
{
public:
  Touches(const std::pair<unsigned int, unsigned int> &pair, const HistoryRow &first,
          const HistoryRow *row_before)
      : collision{pair.first, pair.second, first.time, first.time},
        before(difference(row_before ? *row_before : first, collision, &BodyRecord::position)),
        half_widths(to_vector(first.bodies[pair.first].half_widths) +
                    to_vector(first.bodies[pair.second].half_widths)),
        is_from_the_start(row_before == nullptr)
  {
  }

  void add_touch(const HistoryRow &row)
  {
    one.add(row.bodies[collision.one]);
    other.add(row.bodies[collision.other]);
    collision.end = row.time;
    is_touching = true;
    has_parted = false;
  }

  void add_gap(const HistoryRow &row)
  {
    if (is_touching)
    {
      one.add(row.bodies[collision.one]);
      other.add(row.bodies[collision.other]);
      after = difference(row, collision, &BodyRecord::position);
      line = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(one.weighted() + other.weighted())
                 .eigenvectors()
                 .col(2);
    }
    is_touching = false;
    is_parting = difference(row, collision, &BodyRecord::position).dot(line) *
                     difference(row, collision, &BodyRecord::velocity).dot(line) >
                 0.;
    has_parted |= is_parting;
  }

  /// Whether the next touch will be another collision.
  bool is_over() const { return has_parted && !is_parting; }

  Collision judge() const
  {
    using Outcome = Collision::Outcome;
    Collision judged = collision;
    if (has_parted && have_exchanged_sides())
      judged.outcome = Outcome::passed_through;
    else if (has_parted)
      judged.outcome = is_from_the_start ? Outcome::touching_from_the_start : Outcome::bounced;
    return judged;
  }

private:
  /// Beside each other the centres may change their order along the line a little without meaning.
  bool have_exchanged_sides() const
  {
    const double way = std::abs(before.dot(line) - after.dot(line));
    return before.dot(line) * after.dot(line) < 0. && way >= 0.5 * line.cwiseAbs().dot(half_widths);
  }

  Collision collision;
  Eigen::Vector3d before, after = Eigen::Vector3d::Zero(); // from the centre of `other` to that of `one`
  Eigen::Vector3d half_widths;                             // of both together
  Eigen::Vector3d line = Eigen::Vector3d::Zero();
  Push one, other;
  bool is_from_the_start;
  bool is_touching = true, is_parting = false, has_parted = false;
};
} // namespace

std::vector<Collision> find_collisions(const std::vector<HistoryRow> &history, double largest_penetration)
{
  constexpr double least_penetration = 0.25;
  std::vector<Collision> collisions;
  std::map<std::pair<unsigned int, unsigned int>, Touches> open;
  for (std::size_t i = 0; i < history.size(); ++i)
  {
    const HistoryRow &row = history[i];
    for (const auto &pair : row.touching)
    {
      const auto known = open.find(pair);
      if (known != open.end() && known->second.is_over())
      {
        collisions.push_back(known->second.judge());
        open.erase(known);
      }
      open.try_emplace(pair, pair, row, i > 0 ? &history[i - 1] : nullptr).first->second.add_touch(row);
    }
    for (auto &[pair, touches] : open)
      if (row.touching.count(pair) == 0)
        touches.add_gap(row);
  }
  for (const auto &[pair, touches] : open)
    collisions.push_back(touches.judge());
  for (Collision &collision : collisions)
    if (collision.outcome == Collision::Outcome::passed_through && largest_penetration < least_penetration)
      collision.outcome = Collision::Outcome::bounced;
  std::stable_sort(collisions.begin(), collisions.end(),
                   [](const Collision &a, const Collision &b) { return a.end < b.end; });
  return collisions;
}

std::string name_of(Collision::Outcome outcome)
{
  switch (outcome)
  {
  case Collision::Outcome::bounced:
    return "bounced";
  case Collision::Outcome::passed_through:
    return "passed through";
  case Collision::Outcome::touching_from_the_start:
    return "touching from the start";
  default:
    return "touching";
  }
}

const std::string &name_of_collider(const Parameters &parameters, unsigned int index)
{
  const std::size_t n_bodies = parameters.bodies.size();
  return index < n_bodies ? parameters.bodies[index].name : parameters.obstacles[index - n_bodies].name;
}
} // namespace signorini
