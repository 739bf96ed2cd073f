// SPDX-License-Identifier: MIT
#include "demo/size_over_path.h"

#include <algorithm>
#include <cmath>

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
    int frame;    // the later one of the two
    bool ofSize;  // a change of size shows in it
    double squared;
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
    int lastLowering = -1;
    bool fading = false;
    for (int i = 0; i < settings.frames; ++i) {
        const int last = run.chosen().resolution;
        goTo(i);
        run.change(shown);
        run.step();
        glFinish();  // so that every frame has the demand of the one before, on any machine
        const ChosenResolution& now = run.chosen();
        result.sizes.push_back(now.resolution);
        result.largestArtifactRatio = std::max(result.largestArtifactRatio, now.artifactRatio);
        if (now.resolution > last) ++result.raises;
        if (now.resolution < last) {
            ++result.lowerings;
            if (lastLowering >= 0 && (result.leastFramesBetweenLowerings == 0 ||
                                      i - lastLowering < result.leastFramesBetweenLowerings))
                result.leastFramesBetweenLowerings = i - lastLowering;
            lastLowering = i;
        }
        renderer::FloatImage visibility = frame.readVisibility();
        // The last step of a fade is one from a mixture to the new map alone.
        const bool shows = now.resolution != last || fading || now.fadeWeight < 1;
        fading = now.fadeWeight < 1;
        if (i > 0) changes.push_back({i, shows, squaredChange(before, visibility)});
        before = std::move(visibility);
    }

    // What the motion itself changes: of every changing frame, and of some others.
    renderer::FrameSettings compared = run.frameSettings();
    compared.resolution = settings.comparedN;
    compared.minRadiusUv = 0;
    compared.fadeWeight = 1;
    compared.lit = false;
    const auto visibilityAt = [&](int i) {
        goTo(i);
        compared.radiusUv = static_cast<float>(shown.radiusUv);
        frame.render(compared);
        return frame.readVisibility();
    };
    constexpr int kEvery = 16;
    for (const Change& change : changes) {
        if (!change.ofSize && change.frame % kEvery != 0) continue;
        const double motion =
            squaredChange(visibilityAt(change.frame - 1), visibilityAt(change.frame));
        const double ratio = std::sqrt(change.squared / std::max(motion, 1e-12));
        double& worst = change.ofSize ? result.worstJump : result.worstBetween;
        worst = std::max(worst, ratio);
    }
    goTo(settings.frames - 1);
    return result;
}

}  // namespace demo
