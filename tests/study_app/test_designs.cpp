// SPDX-License-Identifier: MIT
#include "tests/study_app/test_designs.h"

#include "study_app/design_file.h"
#include "tests/project_folders.h"

namespace tests {

std::filesystem::path shippedDesignFile(const std::string& name) {
    return sourceFolder() / "data/designs" / (name + ".json");
}

study_app::Design shippedDesign(const std::string& name) {
    return study_app::readDesign(shippedDesignFile(name));
}

study_app::Design variedDesign(records::Task task) {
    using records::Pattern;
    study_app::Design design;
    design.name = "varied";
    design.task = task;
    design.artifactPx = {8, 3};
    design.patterns = {{.pattern = Pattern::stair},
                       {.pattern = Pattern::step},
                       {.pattern = Pattern::step, .orientation = study_app::Orientation::vertical},
                       {.pattern = Pattern::line, .angleDeg = 22.5}};
    design.litLevels = {1, 0.25};
    design.kernels = {"disc", "poisson4"};
    design.dither = true;
    design.localise = task == records::Task::yesNo;
    design.trialsPerCondition = 6;
    design.catchShare = 0.2;
    if (task == records::Task::yesNo) {
        design.staircase = quest::forYesNo(quest::kDefaultParameters, study_app::kYesNoGamma);
    }
    return design;
}

}  // namespace tests
