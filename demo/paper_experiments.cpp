// SPDX-License-Identifier: MIT
#include "demo/paper_page.h"
#include "program/run_program.h"

namespace {

std::string names() {
    std::string all;
    for (const demo::PaperTitle& title : demo::paperTitles())
        all += (all.empty() ? "" : ", ") + title.name;
    return all;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "The papers' own figures and tables, drawn and measured again: pages of Markdown with "
        "pictures."};
    std::vector<std::string> papers;
    std::filesystem::path out = "docs/papers";
    int rounds = 9;
    app.add_option("papers", papers, "which; default: all of " + names());
    app.add_option("--out", out, "folder of the pages")->capture_default_str();
    app.add_option("--rounds", rounds, "timed rounds")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    return program::run(app, argc, argv, [&] {
        if (papers.empty())
            for (const demo::PaperTitle& title : demo::paperTitles()) papers.push_back(title.name);
        const renderer::HeadlessContext context;
        records::RunContext run =
            records::currentRunContext("paper_experiments", {argv, argv + argc});
        run.glRenderer = context.info().renderer;
        run.glVersion = context.info().version;
        for (const std::string& paper : papers)
            demo::writePaperPage(out, paper, context.info(), run, rounds);
    });
}
