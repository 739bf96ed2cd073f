// SPDX-License-Identifier: MIT
#include "study_app/session_start.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <random>
#include <stdexcept>

#include "records/participants_table.h"
#include "records/quoted_text.h"
#include "study_app/display_file.h"
#include "study_app/frame_images.h"

namespace study_app {
namespace {

std::uint64_t freshSeed() {
    std::random_device device;
    // Below 2^53, so that every tool that reads the sidecar's JSON reads the same number.
    return (static_cast<std::uint64_t>(device()) << 21) ^ device();
}

records::ParticipantDetails detailsFrom(const SetupForm& form) {
    records::ParticipantDetails details{
        .age = {}, .gender = form.gender, .expertise = form.expertise};
    if (!form.age.empty()) details.age = std::stod(form.age);
    return details;
}

/// A field of the set-up screen beside the cell of participants.tsv that it belongs to.
struct Detail {
    const char* column;
    std::string& typed;
    std::string& filledIn;
    std::string known;  // empty: n/a, or nobody of that name
};

std::array<Detail, 3> detailsOf(SetupState& setup) {
    SetupForm& form = setup.form;
    records::ParticipantDetails known;
    if (!form.participant.empty()) {
        known = records::readParticipant(form.dataFolder, form.participant).value_or(known);
    }
    return {Detail{"age", form.age, setup.filledAge,
                   known.age ? records::exactText(*known.age) : std::string()},
            Detail{"gender", form.gender, setup.filledGender, known.gender},
            Detail{"expertise", form.expertise, setup.filledExpertise, known.expertise}};
}

/// A session that was found before is not begun anew because its files went away meanwhile.
std::string lostRows(const SetupState& setup, const ExistingSession& now) {
    if (now.state == ExistingSession::State::unusable || now.rows >= setup.rowsFound) return {};
    return tableOf(setup.form).string() + ": holds " + std::to_string(now.rows) +
           " rows: must hold the " + std::to_string(setup.rowsFound) +
           " that were there before: put them back, then try again";
}

/// What the table says of somebody who was here before; what was typed stays.
void fillIn(Detail& detail) {
    if (detail.typed == detail.filledIn) detail.typed.clear();
    detail.filledIn.clear();
    if (!detail.typed.empty() || detail.known.empty()) return;
    detail.typed = detail.filledIn = detail.known;
}

/// As participants.tsv would hold it: "31.0" is "31".
std::string plainNumber(const std::string& text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end ? records::exactText(number) : text;
}

/// Whoever changes what was filled in has seen it, and corrects it.
void requireNoContradiction(const Detail& detail, const SetupForm& form) {
    if (detail.typed.empty() || detail.known.empty() || detail.filledIn == detail.known) return;
    if (detail.typed == detail.known || plainNumber(detail.typed) == detail.known) return;
    throw std::runtime_error(
        (std::filesystem::path(form.dataFolder) / "participants.tsv").string() + ": sub-" +
        form.participant + ": " + detail.column + " is " + records::quotedText(detail.known) +
        " there and " + records::quotedText(detail.typed) +
        " here: leave it out, or choose another participant");
}

std::optional<double> reading(const std::string& text, const char* ofWhat) {
    if (text.empty()) return {};
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && stop == end) return number;
    throw std::runtime_error(std::string("Luminance of ") + ofWhat + ": " +
                             records::quotedText(text) + ": must be a number, in cd/m2");
}

std::string readingText(const std::optional<double>& value) {
    return value ? records::exactText(*value) : std::string();
}

/// What the form leaves empty stays as it is in the table.
void storeDetails(const SetupForm& form) {
    const records::ParticipantDetails known =
        records::readParticipant(form.dataFolder, form.participant)
            .value_or(records::ParticipantDetails{});
    records::ParticipantDetails details = detailsFrom(form);
    if (!details.age) details.age = known.age;
    if (details.gender.empty()) details.gender = known.gender;
    if (details.expertise.empty()) details.expertise = known.expertise;
    if (details != known) records::writeParticipant(form.dataFolder, form.participant, details);
}

}  // namespace

void lookUp(SetupState& setup) {
    const bool newFolder = !setup.lookedUp || setup.lookedUp->dataFolder != setup.form.dataFolder;
    const bool newPerson = newFolder || setup.lookedUp->participant != setup.form.participant;
    setup.design.reset();
    setup.summary.clear();
    setup.existing = findExisting(setup.form);
    if (newPerson || setup.lookedUp->session != setup.form.session) setup.rowsFound = 0;
    setup.problem = setup.existing.problem + lostRows(setup, setup.existing);
    setup.rowsFound = std::max(setup.rowsFound, setup.existing.rows);
    try {
        if (newFolder) setup.participants = describeParticipants(setup.form.dataFolder);
        setup.design = setup.existing.design ? *setup.existing.design : designOf(setup.form);
        setup.summary = describeDesign(*setup.design);
        auto details = detailsOf(setup);
        if (newPerson) std::ranges::for_each(details, fillIn);
        for (const Detail& detail : details) requireNoContradiction(detail, setup.form);
    } catch (const std::exception& error) {
        setup.problem = error.what();
    }
    if (setup.problem.empty()) setup.problem = notWritable(setup.form.dataFolder);
    setup.lookedUp = setup.form;
}

records::ScreenLuminance luminanceTyped(const CalibrationState& c) {
    return {.black = reading(c.blackText, "black"),
            .grey = reading(c.greyText, "grey"),
            .white = reading(c.whiteText, "white")};
}

CalibrationState loadCalibration(const Window& window, const std::filesystem::path& displays) {
    CalibrationState c;
    c.warnings = displayWarnings(window.displayState());
    c.profile = window.monitor();
    c.cardWidthPx *= window.uiScale();
    const auto known = findDisplay(readDisplays(displays), c.profile);
    if (!known) return c;
    c.profile = *known;
    c.known = true;
    if (known->pxPerMm) {
        c.cardWidthPx = std::round(*known->pxPerMm * kCardWidthMm);
        c.cardMatched = true;
    }
    if (known->distanceMm) c.distanceCm = *known->distanceMm / 10;
    c.distanceGiven = known->distanceMm.has_value();
    if (known->gamma) c.greyCode = greyCodeOfHalfLight(*known->gamma);
    c.gammaGiven = known->gamma.has_value();
    c.blackText = readingText(known->luminance.black);
    c.greyText = readingText(known->luminance.grey);
    c.whiteText = readingText(known->luminance.white);
    return c;
}

bool storeCalibration(CalibrationState& c, const std::filesystem::path& displays) {
    const DisplayProfile before = c.profile;
    DisplayProfile& p = c.profile;
    if (c.cardMatched) p.pxPerMm = pxPerMmFromCard(c.cardWidthPx);
    if (c.distanceGiven) p.distanceMm = 10 * c.distanceCm;
    if (c.gammaGiven) p.gamma = gammaFromGreyCode(c.greyCode);
    c.problem.clear();
    try {
        p.luminance = luminanceTyped(c);
        if (const std::string broken = validate(p); !broken.empty()) {
            throw std::runtime_error(broken);
        }
        if (p != before) storeDisplay(displays, p);
    } catch (const std::runtime_error& error) {
        c.problem = error.what();
        p = before;
    }
    return c.problem.empty();
}

std::unique_ptr<SessionRunner> startSession(const AppState& state,
                                            const records::RunContext& context) {
    const SetupForm& form = state.setup.form;
    const ExistingSession existing = findExisting(form);
    if (const std::string lost = lostRows(state.setup, existing); !lost.empty()) {
        throw std::runtime_error(lost);
    }
    const SessionRequest request =
        requestFrom(form, existing, state.calibration.profile, freshSeed(), context);
    const bool over = existing.state == ExistingSession::State::finished;
    if (request.design.frames && !over) requireFrames(*request.design.frames);
    auto runner = std::make_unique<SessionRunner>(request);
    storeDetails(form);
    return runner;
}

std::unique_ptr<SessionRunner> startRerun(const SessionRunner& before,
                                          const std::string& condition) {
    return std::make_unique<SessionRunner>(rerunRequest(before.request(), condition, freshSeed()));
}

Results resultsOf(const SessionRunner& runner) {
    const std::vector<Run> runs = runsOf(runner.request());
    return {.conditions = runResults(runs), .attention = catchResult(runs)};
}

}  // namespace study_app
