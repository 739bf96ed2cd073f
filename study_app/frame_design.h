// SPDX-License-Identifier: MIT
// Designs that show rendered frames: does a slope measured on plane edges hold there?
//
// A condition is one scene at one blur radius r. Its staircase moves along r / a: what it proposes
// is answered with the nearest pair of frames that there is, on a logarithmic scale, and it learns
// from that one. So r stands still and a varies, where edges have it the other way round.
#pragma once

#include <string>
#include <vector>

#include "study_app/design.h"

namespace study_app {

/// Empty when usable; else "<field>: <value>: <rule>", as validate(). Of a design with frames.
std::string validateFrames(const Design& design);

/// By scene and radius in the order of the list, the frames of each by rising r / a.
std::vector<Condition> frameConditions(const Design& design);

/// The frame of a condition whose r / a is nearest to the proposed ratio; of two as near, the one
/// with the finer map.
const records::FramePair& nearestFrame(const Condition& condition, double ratio);

/// Puts a frame into a row: its a, its r and its name.
void show(records::Trial& trial, const records::FramePair& frame);

}  // namespace study_app
