// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/keyframes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/scene/motion.h"

namespace sheet::scene {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d smooth_place(double t) { return {std::sin(2 * t), std::exp(-t), t * std::cos(3 * t)}; }
Quaterniond smooth_rotation(double t) {
  return Quaterniond(AngleAxisd(1.5 * std::sin(t), Vector3d::UnitX())) *
         Quaterniond(AngleAxisd(t * t, Vector3d(1, 2, -1).normalized()));
}

// With rows of uneven distance if `uneven`.
std::vector<double> times_to(double end, int pieces, bool uneven = false) {
  std::vector<double> times;
  for (int i = 0; i <= pieces; ++i) {
    const double s = static_cast<double>(i) / pieces;
    times.push_back(end * (uneven ? s + 0.1 * std::sin(2 * std::numbers::pi * s) : s));
  }
  return times;
}

Keyframes smooth(int pieces, bool uneven = true) {
  const std::vector<double> times = times_to(2, pieces, uneven);
  std::vector<Vector3d> places;
  std::vector<Quaterniond> rotations;
  for (const double t : times) {
    places.push_back(smooth_place(t));
    rotations.push_back(smooth_rotation(t));
  }
  return {times, places, rotations};
}

// The largest deviation between rows, over the whole time.
double largest(const std::function<double(double)>& deviation) {
  double result = 0;
  for (double t = 0; t < 2; t += 0.00371)
    result = std::max(result, deviation(t));
  return result;
}

double angle_between(const Eigen::Isometry3d& pose, const Quaterniond& wanted) {
  return rotation_vector(wanted.conjugate() * Quaterniond(pose.linear())).norm();
}

TEST(Keyframes, AreExactAtTheRows) {
  const Keyframes rows = smooth(13);
  for (std::size_t i = 0; i < rows.times().size(); ++i) {
    const Eigen::Isometry3d pose = rows.pose(rows.times()[i]);
    EXPECT_EQ(pose.translation(), rows.places()[i]);
    EXPECT_LT((pose.linear() - rows.rotations()[i].toRotationMatrix()).norm(), 4e-15);
  }
}

TEST(Keyframes, ConvergeWithFourthOrderUpToTheEnds) {
  const auto monotone_place = [](double t) { return Vector3d(std::sin(0.7 * t), std::exp(-t), t + t * t * t); };
  const auto place_error = [&](int pieces) {
    const std::vector<double> times = times_to(2, pieces, true);
    std::vector<Vector3d> places;
    for (const double t : times)
      places.push_back(monotone_place(t));
    const Keyframes rows(times, places, {});
    return largest([&](double t) { return (rows.pose(t).translation() - monotone_place(t)).norm(); });
  };
  const auto turn_error = [](int pieces) {
    const Keyframes rows = smooth(pieces);
    return largest([&](double t) { return angle_between(rows.pose(t), smooth_rotation(t)); });
  };
  EXPECT_GT(std::log2(place_error(160) / place_error(320)), 3.9);
  EXPECT_GT(std::log2(turn_error(160) / turn_error(320)), 3.9);
  EXPECT_LT(place_error(80), 1e-5);
  EXPECT_LT(turn_error(80), 1e-5);
}

TEST(Keyframes, ConvergeWithSecondOrderWhereTheyTurnBack) {
  const auto error = [](int pieces) {
    const Keyframes rows = smooth(pieces);
    return largest([&](double t) { return (rows.pose(t).translation() - smooth_place(t)).norm(); });
  };
  EXPECT_GT(std::log2(error(80) / error(320)) / 2, 1.7);
  EXPECT_LT(error(320), 1e-4);
}

// The pancake's pan, and a random walk with rests.
TEST(Keyframes, PlacesStayBetweenTheirRows) {
  std::vector<double> times{0, 0.3, 0.4, 0.6};
  std::vector<Vector3d> places{{0, -0.005, 0}, {0, -0.005, 0}, {0, 0.07, 0}, {0, -0.005, 0}};
  auto noise = [state = 1U]() mutable {
    state = state * 1664525U + 1013904223U;
    return state / 4294967296.0;
  };
  for (int i = 0; i < 200; ++i) {
    times.push_back(times.back() + 0.01 + noise());
    const Vector3d step(noise() - 0.5, noise() < 0.5 ? 0 : noise() - 0.3, i % 7 == 0 ? 10 : 0.01);
    places.emplace_back(places.back() + step);
  }
  const Keyframes rows(times, places, {});
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Vector3d low = places[i].cwiseMin(places[i + 1]), high = places[i].cwiseMax(places[i + 1]);
    for (int k = 1; k < 40; ++k) {
      const double t = times[i] + (times[i + 1] - times[i]) * k / 40;
      const Vector3d place = rows.pose(t).translation(), velocity = rows.rates(t).velocity;
      const double rounding = 1e-14 * high.cwiseAbs().maxCoeff();
      EXPECT_LE((low - place).maxCoeff(), rounding) << "row " << i;
      EXPECT_LE((place - high).maxCoeff(), rounding) << "row " << i;
      EXPECT_GE((velocity.array() * (places[i + 1] - places[i]).array()).minCoeff(), -1e-12);
      for (int d = 0; d < 3; ++d)
        EXPECT_TRUE(low[d] < high[d] || place[d] == low[d]);
    }
  }
}

// There and back by the same axis, with a rest between.
TEST(Keyframes, TurnsStayBetweenTheirRows) {
  const Vector3d axis = Vector3d(1, 2, -2) / 3;
  const std::vector<double> times{0, 0.2, 0.3, 1, 1.1, 2, 2.1}, angles{0, 0, 1.5, 1.5, 1.4, 3.5, 3.6};
  std::vector<Quaterniond> rotations;
  for (const double angle : angles)
    rotations.emplace_back(AngleAxisd(angle, axis));
  const Keyframes rows(times, {}, rotations);
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    for (int k = 1; k < 40; ++k) {
      const double t = times[i] + (times[i + 1] - times[i]) * k / 40, way = angles[i + 1] - angles[i];
      const double turned = rotation_vector(rotations[i].conjugate() * Quaterniond(rows.pose(t).linear())).dot(axis);
      EXPECT_GE(turned, std::min(way, 0.0) - 1e-14) << t;
      EXPECT_LE(turned, std::max(way, 0.0) + 1e-14) << t;
      EXPECT_GE(rows.rates(t).turning.dot(axis) * way, -1e-13) << t;
    }
}

TEST(Keyframes, LinearOnesMoveStraightWithConstantVelocity) {
  const Quaterniond start = smooth_rotation(0.3), turned = start * Quaterniond(AngleAxisd(1, Vector3d::UnitZ()));
  const Keyframes rows({0, 0.5, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}}, {start, turned, turned}, Vector3d::Zero(),
                       Interpolation::linear);
  EXPECT_LT((rows.pose(0.3).translation() - Vector3d(0.6, 0, 0)).norm(), 1e-15);
  EXPECT_LT((rows.rates(0.3).velocity - Vector3d(2, 0, 0)).norm(), 1e-14);
  EXPECT_LT((rows.rates(0.5).velocity - Vector3d(0, 2, 0)).norm(), 1e-14);
  EXPECT_LT(angle_between(rows.pose(0.3), start * Quaterniond(AngleAxisd(0.6, Vector3d::UnitZ()))), 1e-14);
  EXPECT_LT((rows.rates(0.3).turning - start * Vector3d(0, 0, 2)).norm(), 1e-14);
  EXPECT_EQ(rows.rates(1).turning, Vector3d::Zero());
  EXPECT_NEAR(rows.bounds(0, 2).speed, 2, 1e-14);
  EXPECT_NEAR(rows.bounds(0, 2).turning, 2, 1e-13);
  EXPECT_LT(rows.bounds(0, 2).acceleration, 1e-12);
  EXPECT_EQ(events(Keyframed{std::make_shared<const Keyframes>(rows)}), (std::vector<double>{0, 0.5, 2}));
}

TEST(Keyframes, StepsRestAndJump) {
  const Quaterniond turned(AngleAxisd(1, Vector3d::UnitZ()));
  const Keyframes rows({0, 0.5, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}}, {Quaterniond::Identity(), turned, turned},
                       Vector3d::Zero(), Interpolation::step);
  EXPECT_EQ(rows.pose(0.4999).matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(rows.pose(0.5).translation(), Vector3d(1, 0, 0));
  EXPECT_LT(angle_between(rows.pose(1.9), turned), 1e-15);
  EXPECT_EQ(rows.pose(2).translation(), Vector3d(1, 3, 0));
  EXPECT_EQ(rows.rates(0.5).velocity, Vector3d::Zero());
  EXPECT_EQ(rows.bounds(0, 2).speed, 0);
  const Motion motion = Keyframed{std::make_shared<const Keyframes>(rows)};
  EXPECT_EQ(events(motion), (std::vector<double>{0, 0.5, 2}));
  EXPECT_EQ(motion_between(motion, 0.6, 2).translation(), Vector3d(0, 3, 0));
}

TEST(Keyframes, VelocitiesAreDerivatives) {
  const Keyframes rows = smooth(9);
  const double d = 1e-4;
  const double deviation = largest([&](double t) {
    if (t < 2 * d || t > 2 - 2 * d)
      return 0.0;
    for (const double row : rows.times())
      if (std::abs(t - row) < 2 * d) // where the third derivative jumps
        return 0.0;
    const auto place = [&](double s) -> Vector3d { return rows.pose(t + s * d).translation(); };
    const auto turn = [&](double s) {
      const Eigen::Matrix3d turned = rows.pose(t + s * d).linear() * rows.pose(t).linear().transpose();
      return rotation_vector(Quaterniond(turned));
    };
    const auto difference = [&](const auto& f) -> Vector3d { return (f(-2) - 8 * f(-1) + 8 * f(1) - f(2)) / (12 * d); };
    const auto [velocity, turning] = rows.rates(t);
    return std::max((difference(place) - velocity).norm(), (difference(turn) - turning).norm());
  });
  EXPECT_LT(deviation, 1e-8);
  EXPECT_GT(deviation, 0); // it was measured
}

TEST(Keyframes, VelocitiesGoOnOverRows) {
  const Keyframes rows = smooth(9);
  const double d = 1e-9;
  for (std::size_t i = 1; i + 1 < rows.times().size(); ++i) {
    const auto before = rows.rates(rows.times()[i] - d), after = rows.rates(rows.times()[i]);
    EXPECT_LT((before.velocity - after.velocity).norm(), 1e-6);
    EXPECT_LT((before.turning - after.turning).norm(), 1e-6);
  }
}

TEST(Keyframes, ASteadyTurnIsExact) {
  const Vector3d axis = Vector3d(1, -2, 0.5).normalized();
  const std::vector<double> times = times_to(5, 11, true); // turns of up to 1.9 rad
  std::vector<Quaterniond> rotations;
  for (std::size_t i = 0; i < times.size(); ++i) {
    rotations.emplace_back(AngleAxisd(2.5 * times[i], axis));
    if (i % 3 == 1)
      rotations.back().coeffs() *= -1; // the same rotation
  }
  const Keyframes rows(times, {}, rotations, Vector3d(1, 2, 3));
  for (double t = 0; t < 5; t += 0.0417) {
    EXPECT_LT(angle_between(rows.pose(t), Quaterniond(AngleAxisd(2.5 * t, axis))), 1e-13);
    EXPECT_LT((rows.rates(t).turning - 2.5 * axis).norm(), 1e-12);
    EXPECT_EQ(rows.pose(t).translation(), Vector3d(1, 2, 3));
  }
}

TEST(Keyframes, FewRows) {
  const std::vector<Vector3d> two{{0, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(Keyframes({1, 3}, two, {}).pose(2).translation(), Vector3d(1, 0, 0));
  EXPECT_EQ(Keyframes({1, 3}, two, {}).rates(2).velocity, Vector3d(1, 0, 0));
  const auto fall = [](double t) { return Vector3d(0, -5 * t * t, t); };
  const Keyframes parabola({0, 1, 3}, {fall(0), fall(1), fall(3)}, {});
  EXPECT_LT((parabola.pose(2).translation() - fall(2)).norm(), 1e-14);
  EXPECT_LT((parabola.rates(0.5).velocity - Vector3d(0, -5, 1)).norm(), 1e-14);
  const auto cubic = [](double t) { return Vector3d(t * t * t, 1 - t, t * t); };
  const Keyframes four({0, 1, 3, 4}, {cubic(0), cubic(1), cubic(3), cubic(4)}, {});
  EXPECT_LT((four.pose(2).translation() - cubic(2)).norm(), 1e-14);
}

TEST(Keyframes, RestBeforeTheFirstAndFromTheLastRowOn) {
  const Keyframes rows = smooth(9);
  for (const double t : {-7.0, -1e-9, 2.0, 2.5, 1e300}) {
    EXPECT_TRUE(rows.rates(t).velocity.isZero(0) && rows.rates(t).turning.isZero(0));
    EXPECT_EQ(rows.pose(t).translation(), t < 0 ? rows.places().front() : rows.places().back());
  }
  EXPECT_GT(rows.rates(0).velocity.norm(), 1);
}

TEST(Keyframes, BoundsHold) {
  const Keyframes rows = smooth(9);
  const double d = 1e-5;
  for (double from = -0.2; from < 2; from += 0.13) {
    const double to = from + 0.3;
    const auto [speed, acceleration, turning, change] = rows.bounds(from, to);
    for (double t = from + d; t < to; t += 0.011) {
      const auto [velocity, spin] = rows.rates(t);
      EXPECT_LE(velocity.norm(), speed);
      EXPECT_LE(spin.norm(), turning);
      const auto later = rows.rates(t + d);
      if (t + d > to || t < 0 || t + d >= 2)
        continue;
      EXPECT_LE((later.velocity - velocity).norm() / d, acceleration * (1 + 1e-4));
      EXPECT_LE((later.turning - spin).norm() / d, change * (1 + 1e-4));
    }
  }
  EXPECT_EQ(rows.bounds(2, 3).speed, 0);
  EXPECT_EQ(rows.bounds(-1, 0).speed, 0);
  EXPECT_LT(rows.bounds(0, 2).speed, 12); // but they are no wild guesses: 7.3
}

TEST(Keyframed, IsTheMotionOfTheRowsFrame) {
  const Motion motion = Keyframed{std::make_shared<const Keyframes>(smooth(9))};
  const Keyframes& rows = *std::get<Keyframed>(motion).frames;
  const Vector3d own(0.3, -0.2, 0.9);
  EXPECT_LT((motion_between(motion, 0.4, 1.7) * (rows.pose(0.4) * own) - rows.pose(1.7) * own).norm(), 1e-14);
  const double d = 1e-4;
  const auto at = [&](double s) -> Vector3d { return rows.pose(0.77 + s * d) * own; };
  const Vector3d difference = (at(-2) - 8 * at(-1) + 8 * at(1) - at(2)) / (12 * d);
  EXPECT_LT((velocity_at(motion, 0.77, at(0)) - difference).norm(), 1e-8);
  EXPECT_EQ(events(motion), (std::vector<double>{0, 2}));
}

} // namespace
} // namespace sheet::scene
