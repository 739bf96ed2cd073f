// SPDX-License-Identifier: MIT
#include "demo/direct_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "demo/edge_ripple.h"
#include "demo/error_metrics.h"
#include "demo/frame_facts.h"
#include "demo/map_places.h"
#include "demo/picture.h"
#include "demo/shadow_run.h"
#include "demo/swept_view.h"
#include "demo/tsv_journal.h"
#include "program/progress.h"
#include "records/whole_file.h"

namespace demo {
namespace {

constexpr const char* kJournal = "sweep_direct.tsv";

std::string keyOf(const std::string& scene, const std::string& frame, const std::string& technique,
                  const std::string& policy, const std::string& parameter) {
    return scene + "\t" + frame + "\t" + technique + "\t" + policy + "\t" + parameter;
}

/// A name that files can have.
std::string fileName(std::string text) {
    for (char& letter : text)
        if (letter == ' ' || letter == '/' || letter == ':' || letter == '=') letter = '_';
    return text;
}

/// What one way of choosing the size gave.
struct Drawn {
    int resolution = 0;
    double frameMs = 0;
    renderer::FloatImage visibility;
};

class DirectRun {
  public:
    DirectRun(const renderer::GlInfo& info, const SweepSettings& settings,
              const records::RunContext& context)
        : info_(info),
          settings_(settings),
          table_(readSweep(settings.folder)),
          comparisons_(comparePolicies(table_, RippleOver::eachScene)),
          journal_(settings.folder / kJournal, kDirectColumns,
                   records::contextText(context) + "\n" + settings.plan()),
          view_(info, settings.widthPx, settings.heightPx, settings.frames) {
        for (PolicyComparison& more : comparePolicies(table_, RippleOver::allTogether))
            comparisons_.push_back(std::move(more));
        for (const TsvRow& row : journal_.table().rows())
            done_.insert(keyOf(row.text("scene"), row.text("frame"), row.text("technique"),
                               row.text("policy"), row.text("parameter")));
    }

    void run() {
        program::Progress progress("direct runs", settings_.scenes.size() *
                                                      settings_.softness.size() *
                                                      static_cast<std::size_t>(settings_.frames) *
                                                      settings_.techniques.size());
        for (const std::string& source : settings_.scenes)
            for (const double softness : settings_.softness)
                for (int frame = 0; frame < settings_.frames; ++frame)
                    for (const SweptTechnique& technique : settings_.techniques) {
                        measure(source, softness, frame, technique);
                        progress.advance();
                    }
    }

  private:
    /// Of the technique's calibrated policies, those that the journal does not have here.
    std::vector<PolicyResult> missing(const std::string& scene, int frame,
                                      const std::string& technique) const {
        std::vector<PolicyResult> list;
        if (!settings_.confirmsPolicies) return list;
        for (const PolicyComparison& comparison : comparisons_) {
            if (comparison.technique != technique) continue;
            for (const auto& entry : comparison.entries) {
                const auto same = [&](const PolicyResult& other) {
                    return other.policy == entry.policy && other.step == entry.result->step;
                };
                if (entry.result && std::none_of(list.begin(), list.end(), same) &&
                    !done_.contains(keyOf(scene, std::to_string(frame), technique,
                                          std::string(entry.policy->name),
                                          tsvNumber(entry.result->parameter))))
                    list.push_back(*entry.result);
            }
        }
        return list;
    }

    void measure(const std::string& source, double softness, int frame,
                 const SweptTechnique& technique) {
        const std::string scene = sweptScene(source, softness);
        const std::string& name = technique.name;
        const std::string slope = tsvNumber(settings_.slope.slope.c);
        const std::vector<PolicyResult> policies = missing(scene, frame, name);
        const bool needsAuto = !done_.contains(
            keyOf(scene, std::to_string(frame), name, std::string(kControllerRun), slope));
        const int reference = referenceOf(scene, frame, name);
        if ((policies.empty() && !needsAuto) || reference == 0) return;

        view_.show(source, softness, frame);
        renderer::Renderer& drawn = view_.renderer();
        ShadowRun::Settings run{.technique = technique.technique,
                                .parameters = technique.parameters,
                                .radiusUv = view_.softness().radiusUv,
                                .resolution = reference,
                                .slope = settings_.slope.slope};
        ShadowRun frames(drawn, info_, run);
        frames.step();
        const renderer::FloatImage truth = drawn.readVisibility();
        const renderer::FloatImage places = mapPlaces(drawn);
        const std::vector<Contour> contours = shadowContours(truth, places);

        // The policies look at the frame now, not at what the sweep wrote down.
        const FrameFacts facts =
            policies.empty() ? FrameFacts{} : frameFacts(drawn, settings_.slope.slope);
        std::map<int, Drawn> bySize;
        std::vector<int> chosen;
        for (const PolicyResult& policy : policies) {
            chosen.push_back(chosenSize(*policy.policy, facts, policy.parameter, table_.sizes));
            bySize[chosen.back()];
        }
        std::map<int, std::vector<double>> times;
        for (int round = 0; round < settings_.rounds; ++round)
            for (auto& [size, result] : bySize) {
                run.resolution = size;
                frames.change(run);
                frames.step();  // makes the map
                times[size].push_back(frames.timeWholeFrames(1).median);
                if (round > 0) continue;
                result.resolution = size;
                result.visibility = drawn.readVisibility();
            }
        for (auto& [size, result] : bySize) result.frameMs = spreadOf(times[size]).median;

        const auto write = [&](std::string_view policy, const std::string& parameter,
                               const Drawn& result) {
            const VisibilityError error = compareVisibility(result.visibility, truth);
            const std::vector<float> ripples =
                edgeRipples(result.visibility, truth, places, contours, result.resolution);
            journal_.add({scene, std::to_string(frame), name, std::string(policy), parameter,
                          std::to_string(result.resolution), std::to_string(reference),
                          tsvNumber(result.frameMs), tsvNumber(error.rmse),
                          tsvNumber(summarised(ripples).p95), rippleCountsText(ripples)});
        };
        for (std::size_t i = 0; i < policies.size(); ++i)
            write(policies[i].policy->name, tsvNumber(policies[i].parameter), bySize[chosen[i]]);
        if (!needsAuto) return;
        run.resolution.reset();
        ShadowRun automatic(drawn, info_, run);
        automatic.settle();
        Drawn result;
        result.frameMs = automatic.timeWholeFrames(settings_.rounds).median;
        result.resolution = automatic.chosen().resolution;
        result.visibility = drawn.readVisibility();
        if (frame == 0) {
            records::createFolders(settings_.folder / "pictures");
            writePng(errorPicture(settings_.folder, scene, name),
                     differencePicture(result.visibility, truth, kFullErrorInPictures));
            if (!std::filesystem::exists(litPicture(settings_.folder, scene)))
                writePng(litPicture(settings_.folder, scene), drawn.readLit());
        }
        write(kControllerRun, slope, result);
    }

    /// The size that the sweep took for the truth; 0 for none that other errors compare with.
    int referenceOf(const std::string& scene, int frame, const std::string& technique) const {
        for (const SweepCell& cell : table_.cells)
            if (cell.scene == scene && cell.frame == frame && cell.technique == technique &&
                cell.measured())
                return cell.reference;
        return 0;
    }

    const renderer::GlInfo& info_;
    const SweepSettings& settings_;
    SweepTable table_;
    std::vector<PolicyComparison> comparisons_;
    TsvJournal journal_;
    std::set<std::string> done_;
    SweptView view_;
};

}  // namespace

void runDirect(const renderer::GlInfo& info, const SweepSettings& settings,
               const records::RunContext& context) {
    settings.validate();
    DirectRun(info, settings, context).run();
}

std::filesystem::path errorPicture(const std::filesystem::path& folder, const std::string& scene,
                                   const std::string& technique) {
    return folder / "pictures" / (fileName(scene) + "_" + fileName(technique) + "_error.png");
}

std::filesystem::path litPicture(const std::filesystem::path& folder, const std::string& scene) {
    return folder / "pictures" / (fileName(scene) + ".png");
}

std::vector<DirectRow> readDirect(const std::filesystem::path& folder) {
    std::vector<DirectRow> rows;
    if (!std::filesystem::exists(folder / kJournal)) return rows;
    const TsvTable table = readTsv(folder / kJournal);
    for (const TsvRow& row : table.rows())
        rows.push_back({.scene = row.text("scene"),
                        .technique = row.text("technique"),
                        .policy = row.text("policy"),
                        .parameter = row.text("parameter"),
                        .frame = row.whole("frame"),
                        .resolution = row.whole("resolution"),
                        .reference = row.whole("reference"),
                        .frameMs = row.number("frame_ms"),
                        .rmse = row.number("rmse"),
                        .rippleP95 = row.number("ripple_p95"),
                        .ripples = row.wholes("ripple_counts")});
    return rows;
}

std::optional<DirectResult> directResult(const std::vector<DirectRow>& rows,
                                         const SweepTable& table, const PolicyResult& fromTable,
                                         RippleOver over) {
    DirectResult result;
    RippleCounts ripples;
    double logs = 0;
    for (const std::string& scene : table.scenes) {
        RippleCounts ofScene;
        double sum = 0;
        for (int frame = 0; frame < table.frames; ++frame) {
            const auto found = std::find_if(rows.begin(), rows.end(), [&](const DirectRow& row) {
                return row.scene == scene && row.frame == frame &&
                       row.technique == fromTable.technique &&
                       row.policy == fromTable.policy->name &&
                       row.parameter == tsvNumber(fromTable.parameter);
            });
            if (found == rows.end()) return std::nullopt;
            sum += found->frameMs;
            result.worstRmse = std::max(result.worstRmse, found->rmse);
            addCounts(ofScene, found->ripples);
        }
        addCounts(ripples, ofScene);
        result.rippleP95 = std::max(result.rippleP95, rippleP95(ofScene));
        logs += std::log(sum / table.frames);
    }
    result.geometricMeanMs = std::exp(logs / static_cast<double>(table.scenes.size()));
    if (over == RippleOver::allTogether) result.rippleP95 = rippleP95(ripples);
    return result;
}

}  // namespace demo
