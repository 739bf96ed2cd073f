// SPDX-License-Identifier: MIT
// What the viewer shows, as one plain struct: command line, panel, keys and state file all change
// this, and Viewer draws it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "demo/loaded_slope.h"
#include "demo/shadow_run.h"
#include "renderer/view_pass.h"

namespace demo {

/// A way that camera or sun go once round while the viewer plays.
enum class Path { still, camera, sun };

struct ViewerState {
    std::string scene = "yard";
    std::string technique = "pcf_disc";
    /// Of techniques whose parameters are not the defaults.
    std::map<std::string, renderer::ParameterValues, std::less<>> parameters = {};
    ResolutionOption resolution = {};     ///< absent: automatic
    int compareWith = 4096;               ///< N of the other frame, where a view has one
    std::optional<double> radiusM = {};   ///< absent: the scene's own softness
    std::optional<double> radiusUv = {};  ///< instead of radiusM
    std::optional<std::filesystem::path> slopeFile = {};  ///< absent: the published slope
    resolution_controller::Audience audience = {};        ///< for whom the automatic size is chosen
    double percentile = 0.98;  ///< share of the edges whose demand is met, [0.5, 1]; 1: of all
    int crossFadeFrames = 8;   ///< over which a change of the automatic size is faded, [0, 120]
    /// For the automatic sizes of all maps together, texels, [1, 1e12]; absent: no budget.
    std::optional<std::int64_t> budgetTexels = {};

    renderer::View view = renderer::View::picture;
    /// Of the frame's maps, whose light and texels a view shows, from 1; beyond the last: the last.
    int viewMap = 1;
    float splitAt = 0.5F;  ///< [0, 1]
    float gain = 4;        ///< of the difference, [1, 64]

    /// Absent: the scene's own.
    std::optional<float> cameraYawDeg = {}, cameraPitchDeg = {}, cameraDistanceM = {};
    std::optional<float> sunAzimuthDeg = {}, sunElevationDeg = {};
    Path path = Path::still;
    double pathPlace = 0;  ///< [0, 1): how far round

    bool panel = true;
    bool timePasses = false;  ///< every pass by itself: slower frames on a software rasteriser

    bool operator==(const ViewerState&) const = default;
};

/// Empty when usable; else a sentence that names field, value and rule. Scene and technique are
/// looked up in their tables.
std::string validate(const ViewerState& state);

/// Throws std::runtime_error that names file, field, value and rule.
ViewerState readViewerState(const std::filesystem::path& file);
/// The slope's file with its whole path: the next start may be in another folder.
void writeViewerState(const std::filesystem::path& file, const ViewerState& state);

renderer::ParameterValues parametersOf(const ViewerState& state);
/// Camera and sun as the state has them, on the scene's paths where it plays one. Pitch and
/// elevation stay over the horizon. `own` is what the scene itself has.
renderer::OrbitCamera cameraOf(const ViewerState& state, const renderer::OrbitCamera& own,
                               const renderer::CameraPath& path);
renderer::Sun sunOf(const ViewerState& state, const renderer::Sun& own,
                    const renderer::SunPath& path);

/// A camera's distance, nearer or farther by a factor, within what suits the scene's own camera.
float zoomed(float distanceM, float factor, const renderer::OrbitCamera& own);

/// What stands behind `option` in a scene's source ("yard:cascades=4", "model.obj:cascades=4");
/// `standard` where it is not there or no number.
int sceneOption(const std::string& source, const std::string& option, int standard);
/// The source with another value there; without the option for the standard value.
std::string withSceneOption(const std::string& source, const std::string& option, int value,
                            int standard);

/// A word of the command line. Throws std::invalid_argument that names `option` and lists the
/// words.
renderer::View parseView(const std::string& word, const std::string& option);
Path parsePath(const std::string& word, const std::string& option);

/// One line per key, for --help and the panel.
std::string keyHelp();
inline constexpr char kReloadKey = 'L';  ///< reads the shaders again: nothing of the state
/// What a key does to the state. Returns false for a key that means nothing.
bool applyKey(char key, ViewerState& state);

}  // namespace demo
