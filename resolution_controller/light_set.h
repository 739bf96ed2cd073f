// SPDX-License-Identifier: MIT
// Several lights - cascades, cube faces, lamps - under one budget of texels or bytes.
//
//     LightSet lights(settingsOfEachLight);
//     // every frame:
//     for (...) data[i] = {.kind = LightData::Kind::histogram, .histogram = &recent[i].sum()};
//     const LightSummary summary = lights.update(data, decisions, {.texels = 16 << 20});
//
// Each light has a ResolutionController. Where the sizes that these ask for fit into the budget,
// they are the decisions. Where they do not, texel_budget.h shares it out by each light's need,
// held for a while like its size (raised at once, lowered late, HeldNeed), so that lights do not
// trade texels back and forth on a still scene. A light that gets less than it asked for says
// limitedByBudget and how far to enlarge its filter.
//
// Nothing is reserved for a light above the level that meets its held need, nor, while that need is
// kept from falling by a pause, above the size that the light would choose alone.
//
// The constructor allocates and throws; update() does neither.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "resolution_controller/resolution_controller.h"
#include "resolution_controller/texel_budget.h"

namespace resolution_controller {

/// What is known of one light in one frame.
struct LightData {
    enum class Kind : std::uint8_t {
        none = 0,       ///< no data this frame: the size is held
        radius = 1,     ///< PCF: radiusUv
        histogram = 2,  ///< PCSS and the like: *histogram; a null pointer counts as `none`
        off = 3         ///< draws no shadow: keeps its size and takes nothing from the budget
    };
    Kind kind = Kind::none;
    double radiusUv = 0;
    const DemandHistogram* histogram = nullptr;
    Frame frame = {};  ///< a budgetSize in it limits this light beside the common budget
};

struct Budget {
    /// For all maps together: texels, or bytes where Settings::budgetPerTexel counts bytes. Absent:
    /// no budget. 0 and less: every light at its smallest size. Maps that are faded from are not
    /// counted.
    std::optional<std::int64_t> texels = {};
};

struct LightSummary {
    BudgetUse budget;               ///< without a budget, feasible
    std::int32_t changes = 0;       ///< lights whose size changed
    double worstArtifactRatio = 0;  ///< largest artifactRatio of the lights that are on
    std::size_t worstLight = 0;     ///< the first light that has it
    bool operator==(const LightSummary&) const = default;
};

/// A need that rises at once and falls late. A light that falls, gets a smaller map and asks for
/// more again would trade its texels for ever: so it pauses as a size does (fall_memory.h).
struct HeldNeed {
    std::int32_t texels = 0;
    std::int32_t framesBelow = 0;
    std::int32_t largestBelow = 0;
    std::int32_t fellTo = 0;  ///< at the last fall
    FallMemory falls = {};
    LightData::Kind fellBy = LightData::Kind::none;  ///< data of another kind take nothing back
    /// Rules::needsRemembered alone: a need to which nothing falls, since a fall to it was taken
    /// back; 0 none.
    std::int32_t regretted = 0;
    bool operator==(const HeldNeed&) const = default;
};

class LightSet {
  public:
    /// One light for each entry; none is allowed, more than kMostLights are not. Throws
    /// std::invalid_argument that names the light, field, value and rule.
    explicit LightSet(std::span<const Settings> settings);

    /// One entry of `data` and of `decisions` for each light, in order. Lights that the shorter
    /// span leaves out are held without data.
    LightSummary update(std::span<const LightData> data, std::span<Decision> decisions,
                        const Budget& budget = {}) noexcept;

    /// As ResolutionController::reconfigure; no such light is a complaint, too.
    std::string reconfigure(std::size_t light, const Settings& settings);

    std::size_t count() const noexcept { return lights_.size(); }
    /// light < count().
    const ResolutionController& light(std::size_t light) const { return lights_[light].controller; }
    const HeldNeed& heldNeed(std::size_t light) const { return lights_[light].need; }
    /// Goes on from a state that was taken of another set. Throws std::invalid_argument as the
    /// constructor; light < count().
    void restore(std::size_t light, const ControllerState& state, const HeldNeed& need);
    /// From here on, with no fall in mind: older ones are for traces of their time.
    void decideBy(Rules rules) noexcept;
    Rules rules() const noexcept { return rules_; }

  private:
    struct Light {
        ResolutionController controller;
        HeldNeed need;
        ControllerState before;  // of this frame
        bool on = true;
    };

    void decideAlone(Light& light, const LightData& data, Decision& decision) noexcept;
    BudgetUse share(std::span<const LightData> data, std::span<Decision> decisions,
                    std::int64_t budget) noexcept;

    Rules rules_ = kPresentRules;
    std::vector<Light> lights_;
    std::vector<BudgetLight> shares_;
    std::vector<std::uint32_t> scratch_;
    std::vector<Decision> decisions_;
};

/// Empty when a light of a set could hold this need; else a sentence.
std::string validate(const HeldNeed& need);

}  // namespace resolution_controller
