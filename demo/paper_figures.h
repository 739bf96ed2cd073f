// SPDX-License-Identifier: MIT
// The figures of the papers behind the techniques that are drawn again with our scenes: a list,
// from which paper_experiments makes docs/papers. A row says which figure it is, what is drawn,
// what is measured on it and in what ours differs.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "demo/picture.h"
#include "renderer/scene.h"

namespace demo {

/// One picture: a technique at one size and softness.
struct PaperPanel {
    std::string caption;
    std::string technique;
    std::vector<std::pair<std::string, float>> parameters = {};  ///< others at their defaults
    int resolution = 1024;                                       ///< N; 0: automatic
    double radiusTexels = 0;                                     ///< of that N, > 0, or
    double radiusM = 0;                                          ///< in the scene
};

enum class PaperShow {
    lit,
    visibility,
    raisedContrast,  ///< visibility times kRaisedContrast
};
inline constexpr double kRaisedContrast = 4;

/// What is measured on a panel's visibility.
enum class PaperNumber {
    rmse,        ///< against the truth, over penumbra pixels
    umbraLight,  ///< mean where the truth is dark all around
    litLight,    ///< mean where the truth is lit all around
    litDark,     ///< share of those pixels that are darker than .9
    edgeWidth,   ///< 10-90 %, px
    edgeRipple,  ///< 95th percentile of the stair-steps along the edge
};
std::string toText(PaperNumber number);

struct PaperFigure {
    std::string paper;  ///< page that it stands on
    std::string name;   ///< of its files
    std::string title;
    std::string scene;
    std::optional<renderer::OrbitCamera> camera = {};  ///< absent: the scene's own
    int widthPx = 480, heightPx = 270;
    std::optional<Part> part = {};  ///< of the view, that is shown
    int scale = 1;                  ///< pixels of the picture along one of the view
    PaperShow show = PaperShow::visibility;
    /// What the panels are held against; absent: each against itself on a map of kTruthResolution.
    std::optional<PaperPanel> truth = {};
    int truthSamples = 1;  ///< along a pixel's edge
    /// For each panel the one that it is held against, itself or an earlier one, in place of the
    /// truth; or empty.
    std::vector<std::size_t> heldAgainst = {};
    std::vector<PaperNumber> numbers;
    /// How far from any other light numbers of dark and of lit surfaces are taken; by itself wide
    /// enough for every figure's kernel to end in it.
    int marginPx = 8;
    bool timed = false;
    std::vector<PaperPanel> panels;
    std::string setting;  ///< what is drawn, and the truth
    std::string finding;  ///< what the paper shows, what ours shows, and where and why they differ
};
inline constexpr int kTruthResolution = 4096;

const std::vector<PaperFigure>& paperFigures();
/// Throws std::invalid_argument for a name that is not in the list.
const PaperFigure& findPaperFigure(const std::string& name);

}  // namespace demo
