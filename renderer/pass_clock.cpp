// SPDX-License-Identifier: MIT
#include "renderer/pass_clock.h"

namespace renderer {
namespace {

constexpr std::size_t at(Pass pass) {
    return static_cast<std::size_t>(pass);
}

}  // namespace

std::string_view toText(Pass pass) {
    switch (pass) {
        case Pass::depth:
            return "depth";
        case Pass::prefilter:
            return "prefilter";
        case Pass::prepass:
            return "prepass";
        case Pass::lookup:
            return "lookup";
        case Pass::lit:
            return "lit";
        case Pass::demand:
            return "demand";
    }
    return "unknown pass";
}

PassClock::PassClock(const GlInfo& info) : byQueries_(!info.softwareRasteriser) {}

void PassClock::begin(Pass pass) {
    if (byQueries_) {
        std::vector<Query>& queries = queries_[at(pass)];
        if (used_[at(pass)] == queries.size()) {
            GLuint name = 0;
            glCreateQueries(GL_TIME_ELAPSED, 1, &name);
            queries.emplace_back(name);
        }
        glBeginQuery(GL_TIME_ELAPSED, queries[used_[at(pass)]++].name());
        return;
    }
    glFinish();
    start_ = std::chrono::steady_clock::now();
}

void PassClock::end(Pass pass) {
    if (byQueries_) {
        glEndQuery(GL_TIME_ELAPSED);
        return;
    }
    glFinish();
    times_[at(pass)] +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
            .count();
}

PassTimesMs PassClock::collectMs() {
    for (const Pass pass : kAllPasses)
        for (std::size_t i = 0; i < used_[at(pass)]; ++i) {
            GLuint64 nanoseconds = 0;
            glGetQueryObjectui64v(queries_[at(pass)][i].name(), GL_QUERY_RESULT, &nanoseconds);
            times_[at(pass)] += static_cast<double>(nanoseconds) * 1e-6;
        }
    used_ = {};
    return std::exchange(times_, {});
}

std::string_view PassClock::method() const {
    return byQueries_ ? "timer queries" : "finish and steady clock";
}

}  // namespace renderer
