// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/collisions.h"

#include <gtest/gtest.h>

using namespace signorini;
using Outcome = Collision::Outcome;

namespace
{
constexpr double deep = 1.; // penetration

/// A body above another one at rest: the height and velocity of its centre, and the force on it.
struct Moment
{
  double height, velocity, force;
};

/// One row a second, seen along an axis; 7 m away in the direction of the next one.
std::vector<HistoryRow> make_history(const std::vector<Moment> &moments, unsigned int axis)
{
  std::vector<HistoryRow> history;
  for (const Moment &moment : moments)
  {
    HistoryRow row;
    row.time = static_cast<double>(history.size());
    row.bodies.resize(2);
    row.bodies[0].position[axis] = moment.height;
    row.bodies[0].velocity[axis] = moment.velocity;
    row.bodies[0].position[(axis + 1) % 3] = 7.;
    row.bodies[0].contact_force[axis] = moment.force;
    row.bodies[1].contact_force[(axis + 1) % 3] = 10. * moment.force; // taken up by a support
    if (moment.force != 0.)
      row.touching.emplace(0, 1);
    history.push_back(row);
  }
  return history;
}

/// Expects one collision from `begin` to `end`, along every axis and in either order of the bodies.
void expect_one(const std::vector<Moment> &moments, double begin, double end, Outcome outcome)
{
  std::vector<Moment> below(moments);
  for (Moment &moment : below)
    moment = {-moment.height, -moment.velocity, -moment.force};
  for (unsigned int axis = 0; axis < 3; ++axis)
    for (const auto &view : {moments, below})
    {
      const std::vector<Collision> collisions = find_collisions(make_history(view, axis), deep);
      ASSERT_EQ(collisions.size(), 1u);
      EXPECT_EQ(collisions[0].one, 0u);
      EXPECT_EQ(collisions[0].other, 1u);
      EXPECT_EQ(collisions[0].begin, begin);
      EXPECT_EQ(collisions[0].end, end);
      EXPECT_EQ(collisions[0].outcome, outcome);
    }
}

/// Bodies that have hardly sunk into each other have rolled around each other.
TEST(Collisions, WhatWasNeverDeepHasNotPassedThrough)
{
  const auto history = make_history({{2, -1, 0}, {1, 0, 2}, {-2, -1, 0}}, 2);
  EXPECT_EQ(find_collisions(history, .3).at(0).outcome, Outcome::passed_through);
  EXPECT_EQ(find_collisions(history, .2).at(0).outcome, Outcome::bounced);
}

TEST(Collisions, NothingTouches)
{
  EXPECT_TRUE(find_collisions({}, deep).empty());
  EXPECT_TRUE(find_collisions(make_history({{2, -1, 0}, {1, -1, 0}}, 2), deep).empty());
}

TEST(Collisions, Bounce)
{
  expect_one({{2, -1, 0}, {1, -1, 1}, {.5, 0, 2}, {1, 1, 1}, {2, 1, 0}, {3, 1, 0}}, 1., 3., Outcome::bounced);
}

TEST(Collisions, BounceThatLosesMostOfItsVelocity)
{
  expect_one({{2, -1, 0}, {1, -.1, 1}, {1, .001, 0}}, 1., 1., Outcome::bounced);
}

TEST(Collisions, PassesThroughWithItsVelocityBack)
{
  // The force turns round with the centres, so that it leaves no impulse.
  expect_one({{2, -3, 0}, {1, -2, 1}, {.2, -1, 4}, {-.2, -1, -4}, {-1, -2, -1}, {-2, -3, 0}}, 1., 4.,
             Outcome::passed_through);
}

TEST(Collisions, PassesThroughWithAGapInTheMiddle)
{
  expect_one({{2, -3, 0}, {1, -2, 1}, {.1, -1, 0}, {-.1, -1, 0}, {-1, -2, -1}, {-2, -3, 0}}, 1., 4.,
             Outcome::passed_through);
}

TEST(Collisions, ChatterOfOneImpactIsOneBounce)
{
  // Contact is lost on the way down, and again on the way up.
  expect_one({{2, -3, 0}, {1, -3, 2}, {.9, -2, 0}, {.8, -2, 3}, {.8, 1, 0}, {.9, 1, 1}, {1, 2, 0}, {2, 2, 0}},
             1., 5., Outcome::bounced);
}

TEST(Collisions, ComingBackIsAnotherOne)
{
  const std::vector<Collision> collisions = find_collisions(
      make_history({{2, -1, 0}, {1, 0, 2}, {2, 1, 0}, {2, -1, 0}, {1, 0, 2}, {2, 1, 0}}, 2), deep);
  ASSERT_EQ(collisions.size(), 2u);
  EXPECT_EQ(collisions[0].begin, 1.);
  EXPECT_EQ(collisions[0].end, 1.);
  EXPECT_EQ(collisions[1].begin, 4.);
  EXPECT_EQ(collisions[1].end, 4.);
  for (const Collision &collision : collisions)
    EXPECT_EQ(collision.outcome, Outcome::bounced);
}

TEST(Collisions, TouchingFromTheStart)
{
  expect_one({{1, 0, 2}, {1.5, 1, 1}, {2, 2, 0}, {3, 2, 0}}, 0., 1., Outcome::touching_from_the_start);
  expect_one({{1, 0, 2}, {1.5, 1, 0}}, 0., 0., Outcome::touching_from_the_start);
  expect_one({{.1, -1, 2}, {-1, -1, -1}, {-2, -1, 0}}, 0., 1., Outcome::passed_through);
  expect_one({{1, 0, 2}, {1, 0, 2}}, 0., 1., Outcome::touching);
}

TEST(Collisions, StillInContactAtTheEnd)
{
  expect_one({{2, -1, 0}, {1, -1, 1}, {.5, 1, 1}}, 1., 2., Outcome::touching);
  expect_one({{2, -1, 0}, {1, -1, 1}, {1, 1, 0}, {1.1, 1, 1}}, 1., 3., Outcome::touching);
}

TEST(Collisions, NotPartedWhereTheEndCutsAChatter)
{
  expect_one({{2, -3, 0}, {1, -2, 1}, {.9, -2, 0}}, 1., 1., Outcome::touching);
}

TEST(Collisions, SlidingOffAnEdgeIsNotPassingThrough)
{
  // A block slides over a table, the force up, and falls past its edge.
  std::vector<HistoryRow> history(6);
  const std::array<double, 6> heights{2., 1., 1., 1., 0., -3.}, velocities{-1., 0., 0., -.5, -2., -3.};
  for (unsigned int i = 0; i < history.size(); ++i)
  {
    history[i].time = i;
    history[i].bodies.resize(2);
    history[i].bodies[0].position = {2. * i - 5., 0., heights[i]};
    history[i].bodies[0].velocity = {2., 0., velocities[i]};
  }
  for (const unsigned int i : {1, 2})
  {
    history[i].touching.emplace(0, 1);
    history[i].bodies[0].contact_force[2] = 1.;
  }
  const std::vector<Collision> collisions = find_collisions(history, deep);
  ASSERT_EQ(collisions.size(), 1u);
  EXPECT_EQ(collisions[0].end, 2.);
  EXPECT_EQ(collisions[0].outcome, Outcome::bounced);
}

TEST(Collisions, HittingSideBySideOnAFloorIsNotPassingThrough)
{
  // The floor pushes harder than the bodies do, and one of them lands from a little above the other.
  std::vector<HistoryRow> history(3);
  const std::array<double, 3> distances{-2.1, -2., -2.1}, heights{.1, 0., -.1}, velocities{1., 0., -1.};
  for (unsigned int i = 0; i < history.size(); ++i)
  {
    history[i].time = i;
    history[i].bodies.resize(2);
    history[i].bodies[0].position = {distances[i], 0., heights[i]};
    history[i].bodies[0].velocity = {velocities[i], 0., -2.};
    for (BodyRecord &body : history[i].bodies)
      body.half_widths = {1., 1., 1.};
  }
  history[1].touching.emplace(0, 1);
  history[1].bodies[0].contact_force = {-1., 0., 100.};
  const std::vector<Collision> collisions = find_collisions(history, deep);
  ASSERT_EQ(collisions.size(), 1u);
  EXPECT_EQ(collisions[0].outcome, Outcome::bounced);
}

TEST(Collisions, SeveralComeInTheOrderOfTheirEnds)
{
  std::vector<HistoryRow> history(4);
  for (unsigned int i = 0; i < history.size(); ++i)
  {
    history[i].time = i;
    history[i].bodies.resize(3);
    for (unsigned int body = 0; body < 2; ++body)
    {
      history[i].bodies[body].position[2] = 1.;
      history[i].bodies[body].velocity[2] = 1.;
      history[i].bodies[body].contact_force[2] = 1.;
    }
  }
  history[1].touching = {{0, 2}, {1, 2}};
  history[2].touching = {{0, 2}};
  const std::vector<Collision> collisions = find_collisions(history, deep);
  ASSERT_EQ(collisions.size(), 2u);
  EXPECT_EQ(collisions[0].one, 1u);
  EXPECT_EQ(collisions[1].one, 0u);
}

TEST(Collisions, ObstaclesAreNamedAfterTheBodies)
{
  Parameters parameters;
  parameters.bodies.resize(2);
  parameters.bodies[1].name = "ball";
  parameters.obstacles.resize(1);
  parameters.obstacles[0].name = "floor";
  EXPECT_EQ(name_of_collider(parameters, 1), "ball");
  EXPECT_EQ(name_of_collider(parameters, 2), "floor");
}
} // namespace
