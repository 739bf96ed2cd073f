// SPDX-License-Identifier: MIT
// QUEST once more, written from the textbook with plain loops and nothing clever: no shared code,
// no blocks, no reversed tables. What quest::Quest must agree with.
#pragma once

#include <vector>

#include "quest/quest.h"

namespace slow {

struct Quest {
    explicit Quest(const quest::QuestParameters& parameters);
    void update(double x, int response);
    double quantile(double order) const;
    double mean() const;
    double sd() const;

    quest::QuestParameters p;
    long intervals = 500;
    double eps = 0;
    double order = 0;
    std::vector<double> t, pdf, curve;  // candidates, posterior, P at u_k + eps
};

}  // namespace slow
