// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures from few samples. What is certain about the light (lights seen straight, their mirror images) is told from
// what has gone through random decisions (PathTracer, Light); only the latter is noisy, and it varies slowly on a
// surface. So:
//
//   1. Through the middle of each pixel: what is seen there for certain (Sight), and the mean of the random light of
//      --samples paths along that one ray; more near edges, and where the halves of these differ much for the number of
//      points that smoothing can go over. Each pixel is then a point of one surface, no mixture.
//   2. The two parts of the random light (Light::chance), divided by what layers and mirrors leave of them, are
//      smoothed over points of the same surface (smooth.h).
//   3. Each pixel is put together from rays of its own (a tent two pixels wide, as in draw): none but the middles where
//      neighbours see the same things, else the more, the more their levels differ. Each ray brings what is certain
//      along it, and the smoothed light of those points around it that see the surface that it sees, if need be behind
//      other layers. Where none does, a path is followed.
//
// So edges are as sharp as those of a picture of many samples, whatever the number of samples in 1.
#pragma once
#include "libsheet/render/draw.h"
#include "libsheet/render/path_tracer.h"

namespace sheet::render {

// DrawOptions::noise is not used. With alpha if the tracer cuts out. Picture::noise is that of the two halves of the
// samples, smoothed alike.
[[nodiscard]] Picture draw_denoised(const World& world, const Camera& camera, const PathTracer& tracer,
                                    const DrawOptions& options, const Progress& progress);

} // namespace sheet::render
