// SPDX-License-Identifier: MIT
#include "program/build_info.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/project_folders.h"

namespace {

namespace fs = std::filesystem;
using testing::MatchesRegex;

TEST(BuildInfo, SaysWhatWasBuilt) {
    const program::BuildInfo& info = program::buildInfo();
    EXPECT_THAT(info.version, MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
    EXPECT_THAT(info.revision, MatchesRegex("unknown|[0-9a-f]{12,}(-dirty)?"));
    EXPECT_FALSE(info.buildType.empty());
    EXPECT_FALSE(info.compiler.empty());
    EXPECT_EQ(program::versionLine("x"), "x " + info.version + " (revision " + info.revision +
                                             ", " + info.buildType + ", " + info.compiler + ")");
}

// The script that runs at every build, on a checkout of its own.
class RevisionScript : public testing::Test {
  protected:
    RevisionScript() {
        std::string name = (fs::temp_directory_path() / "stairwell-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        fs::create_directory(folder_ / "outer");
        source_ = folder_ / "outer/source";
        fs::create_directory(source_);
    }
    ~RevisionScript() override { fs::remove_all(folder_); }

    void command(const std::string& text) {
        ASSERT_EQ(std::system((text + " > /dev/null 2>&1").c_str()), 0) << text;
    }
    void git(const fs::path& folder, const std::string& text) {
        command(std::string(STAIRWELL_GIT) + " -C " + folder.string() +
                " -c user.name=t -c user.email=t@t " + text);
    }
    void write(const std::string& text) { std::ofstream(source_ / "file") << text; }
    std::string revision() {
        command(std::string(STAIRWELL_CMAKE) + " -DGIT=" + STAIRWELL_GIT +
                " -DSOURCE=" + source_.string() + " -DHEADER=" + header().string() + " -P " +
                (tests::sourceFolder() / "program/write_revision.cmake").string());
        std::ifstream in(header());
        return {std::istreambuf_iterator<char>(in), {}};
    }
    fs::path header() const { return folder_ / "revision.h"; }

    fs::path folder_, source_;
};

TEST_F(RevisionScript, IsUnknownOutsideACheckout) {
    EXPECT_EQ(revision(), "#define STAIRWELL_REVISION \"unknown\"\n");
    git(folder_ / "outer", "init");
    git(folder_ / "outer", "commit --allow-empty -m x");
    EXPECT_EQ(revision(), "#define STAIRWELL_REVISION \"unknown\"\n")
        << "the checkout around an unpacked archive is not its own";
}

TEST_F(RevisionScript, NamesTheCommitAndWhetherFilesChanged) {
    git(source_, "init");
    write("a");
    git(source_, "add file");
    git(source_, "commit -m x");
    EXPECT_THAT(revision(), MatchesRegex("#define STAIRWELL_REVISION \"[0-9a-f]{12}\"\n"));
    write("b");
    EXPECT_THAT(revision(), MatchesRegex("#define STAIRWELL_REVISION \"[0-9a-f]{12}-dirty\"\n"));
}

TEST_F(RevisionScript, TouchesTheHeaderOnlyWhenItChanges) {
    revision();
    const auto longAgo = fs::last_write_time(header()) - std::chrono::hours(1);
    fs::last_write_time(header(), longAgo);
    revision();
    EXPECT_EQ(fs::last_write_time(header()), longAgo);
}

}  // namespace
