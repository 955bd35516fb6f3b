/// @file
/// Lengths of the ball's moves, over its radius: each has one meaning wherever the ball or its fit looks.
#pragma once

namespace pointhaptics::ball
{

/// Height of the bumps between points. A riding ball keeps as far above the surface, a move may end so much
/// further from the HIP, and a try that did not help is repeated when the HIP has gone half as far.
constexpr double kBump = 0.1;
/// Ways shorter than this count as none, and no ball is smaller than this part of its full size.
constexpr double kNoWay = 1e-4;
/// Bumps push the ball aside by so much: it may wait there, and a move that gets further is worth a look.
constexpr double kAside = 0.25;
/// Points further than this above or below a surface belong to another face.
constexpr double kFace = 0.2;
/// Longest way that is judged from one place: of a glide or a ride, to a point under the HIP, to the next
/// look for a flat place, along a fit (over its radius).
constexpr double kStride = 0.5;
/// Largest distance of the fit's point from the ball's where the ball lies on a smooth surface: with a stride
/// in its place, bumps of the noise on a noisy sphere end the trust, and the force jumps.
constexpr double kTrustPlain = 0.6;
/// A flat place serves so far, and a ball may pass an edge so far beside it. Without flat places hands on
/// small leaves lose half as much force again.
constexpr double kFlatNear = 2.0;
/// Reach of the points about a ball that touch it or tell whether its place is flat. With 1.5 a hand falls
/// through a wedge of 20 degrees.
constexpr double kPlaneReach = 1.4;

} // namespace pointhaptics::ball
