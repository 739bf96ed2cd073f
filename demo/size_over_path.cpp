// SPDX-License-Identifier: MIT
#include "demo/size_over_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace demo {
namespace {

/// Moves camera or sun to a place of the scene's path.
class Walk {
  public:
    Walk(renderer::Renderer& frame, Path path)
        : frame_(frame), path_(path), camera_(frame.scene().camera), sun_(frame.scene().sun) {}

    void to(double place) {
        if (path_ == Path::camera)
            frame_.setCamera(renderer::along(frame_.scene().cameraPath, camera_, place));
        if (path_ == Path::sun) frame_.setSun(renderer::along(frame_.scene().sunPath, sun_, place));
    }

  private:
    renderer::Renderer& frame_;
    Path path_;
    renderer::OrbitCamera camera_;
    renderer::Sun sun_;
};

double squaredChange(const renderer::FloatImage& from, const renderer::FloatImage& to) {
    double sum = 0;
    for (std::size_t i = 0; i < from.values.size(); ++i) {
        const double change =
            static_cast<double>(to.values[i]) - static_cast<double>(from.values[i]);
        sum += change * change;
    }
    return sum;
}

struct Change {
    int frame;       // the later one of the two
    bool ofSize;     // a change of size shows in it
    int from, to;    // sizes of the sun's map that show in it
    double squared;  // of visibility
};

}  // namespace

SizeOverPath sizeOverPath(renderer::Renderer& frame, const renderer::GlInfo& info,
                          const PathSettings& settings) {
    Walk walk(frame, settings.path);
    ShadowRun::Settings shown = settings.run;
    // The softness is the scene's in metres, and the light's window may change on the way.
    const auto goTo = [&](int i) {
        walk.to(std::fmod(settings.share * i / settings.frames, 1.0));
        shown.radiusUv = chooseSoftness(frame, {}, {}).radiusUv;
    };
    goTo(0);
    ShadowRun run(frame, info, shown);
    run.settle();
    SizeOverPath result;
    std::vector<Change> changes;
    renderer::FloatImage before;
    std::vector<int> lastLowering(run.maps().size(), -1);
    bool fading = false;
    int from = run.chosen().resolution;
    for (int i = 0; i < settings.frames; ++i) {
        const std::vector<ChosenResolution> last = run.maps();
        goTo(i);
        run.change(shown);
        run.step();
        glFinish();  // so that every frame has the demand of the one before, on any machine
        result.sizes.push_back(run.chosen().resolution);
        bool changed = false, fades = false;
        for (std::size_t map = 0; map < last.size(); ++map) {
            const ChosenResolution& now = run.maps().at(map);
            result.largestArtifactRatio = std::max(result.largestArtifactRatio, now.artifactRatio);
            changed |= now.resolution != last[map].resolution;
            fades |= now.fadeWeight < 1;
            if (now.resolution > last[map].resolution) ++result.raises;
            if (now.resolution >= last[map].resolution) continue;
            ++result.lowerings;
            const int previous = std::exchange(lastLowering[map], i);
            if (previous >= 0 && (result.leastFramesBetweenLowerings == 0 ||
                                  i - previous < result.leastFramesBetweenLowerings))
                result.leastFramesBetweenLowerings = i - previous;
        }
        renderer::FloatImage visibility = frame.readVisibility();
        // The last step of a fade is one from a mixture to the new map alone.
        const bool shows = changed || fading || fades;
        fading = fades;
        if (changed || !shows) from = last.front().resolution;
        if (i > 0)
            changes.push_back(
                {i, shows, from, result.sizes.back(), squaredChange(before, visibility)});
        before = std::move(visibility);
    }

    // What the motion itself changes: of every changing frame, and of some others.
    renderer::FrameSettings compared = run.frameSettings();
    compared.maps.clear();
    compared.minRadiusUv = 0;
    compared.fadeWeight = 1;
    compared.lit = false;
    const auto visibilityAt = [&](int i, int n) {
        goTo(i);
        compared.resolution = n;
        compared.radiusUv = static_cast<float>(shown.radiusUv);
        frame.render(compared);
        return frame.readVisibility();
    };
    const auto motionAt = [&](int i, int n) {
        return std::max(squaredChange(visibilityAt(i - 1, n), visibilityAt(i, n)), 1e-12);
    };
    constexpr int kEvery = 16;
    for (const Change& change : changes) {
        if (!change.ofSize && change.frame % kEvery != 0) continue;
        const double ratio = std::sqrt(change.squared / motionAt(change.frame, settings.comparedN));
        double& worst = change.ofSize ? result.worstJump : result.worstBetween;
        worst = std::max(worst, ratio);
        if (!change.ofSize) continue;
        const double own =
            std::max(motionAt(change.frame, change.from), motionAt(change.frame, change.to));
        result.worstJumpOverOwn =
            std::max(result.worstJumpOverOwn, std::sqrt(change.squared / own));
    }
    goTo(settings.frames - 1);
    return result;
}

}  // namespace demo
