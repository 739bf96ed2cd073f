// SPDX-License-Identifier: MIT
#include "study_app/session_start.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include "records/participants_table.h"
#include "study_app/display_file.h"

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

/// What participants.tsv says of somebody who was here before.
void fillInDetails(SetupForm& form) {
    const auto known = records::readParticipant(form.dataFolder, form.participant);
    if (!known) return;
    if (known->age) form.age = std::to_string(std::lround(*known->age));
    form.gender = known->gender;
    form.expertise = known->expertise;
}

}  // namespace

void lookUp(SetupState& setup) {
    const bool newFolder = !setup.lookedUp || setup.lookedUp->dataFolder != setup.form.dataFolder;
    const bool newPerson = newFolder || setup.lookedUp->participant != setup.form.participant;
    setup.design.reset();
    setup.summary.clear();
    setup.existing = findExisting(setup.form);
    setup.problem = setup.existing.problem;
    try {
        if (newFolder) setup.participants = describeParticipants(setup.form.dataFolder);
        if (newPerson && !setup.form.participant.empty()) fillInDetails(setup.form);
        setup.design = setup.existing.design ? *setup.existing.design : designOf(setup.form);
        setup.summary = describeDesign(*setup.design);
    } catch (const std::exception& error) {
        setup.problem = error.what();
    }
    if (setup.problem.empty()) setup.problem = notWritable(setup.form.dataFolder);
    setup.lookedUp = setup.form;
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
    c.luminance = known->luminanceCdM2.value_or(0);
    return c;
}

bool storeCalibration(CalibrationState& c, const std::filesystem::path& displays) {
    const DisplayProfile before = c.profile;
    DisplayProfile& p = c.profile;
    if (c.cardMatched) p.pxPerMm = pxPerMmFromCard(c.cardWidthPx);
    if (c.distanceGiven) p.distanceMm = 10 * c.distanceCm;
    if (c.gammaGiven) p.gamma = gammaFromGreyCode(c.greyCode);
    if (c.luminance > 0) p.luminanceCdM2 = c.luminance;
    c.problem.clear();
    try {
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
    const SessionRequest request =
        requestFrom(form, findExisting(form), state.calibration.profile, freshSeed(), context);
    const records::ParticipantDetails details = detailsFrom(form);
    auto runner = std::make_unique<SessionRunner>(request);
    if (details != records::ParticipantDetails{}) {
        records::writeParticipant(form.dataFolder, form.participant, details);
    }
    return runner;
}

std::unique_ptr<SessionRunner> startRerun(const SessionRunner& first, std::size_t condition) {
    SessionRequest request = first.request();
    request.design = rerunDesign(request.design, condition);
    request.seed = freshSeed();
    const std::string base = request.session.value_or("") + "rerun";
    for (int i = 1;; ++i) {
        request.session = base + std::to_string(i);
        const auto table =
            records::trialTablePath(request.dataFolder, request.participant, request.session);
        if (!std::filesystem::exists(table)) break;
    }
    return std::make_unique<SessionRunner>(request);
}

}  // namespace study_app
