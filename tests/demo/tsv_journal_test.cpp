// SPDX-License-Identifier: MIT
#include "demo/tsv_journal.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "records/whole_file.h"
#include "tests/temporary_folder.h"

namespace {

using demo::readTsv;
using demo::TsvJournal;

TEST(TsvJournal, GoesOnWhereItWasKilled) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "made" / "times.tsv";
    {
        TsvJournal journal(file, {"scene", "ms"}, "program bench\nplan 3");
        journal.add({"yard", "1.5"});
        journal.add({"", "n/a"});
    }
    std::ofstream(file, std::ios::app) << "yar";  // torn
    EXPECT_EQ(readTsv(file).size(), 2U);
    TsvJournal journal(file, {"scene", "ms"}, "program bench\nplan 4");
    EXPECT_EQ(journal.table().context(), "program bench\nplan 3\n");  // as it was begun
    journal.add({"plaza", "2"});
    EXPECT_EQ(records::readWholeFile(file),
              "# program bench\n# plan 3\nscene\tms\nyard\t1.5\n\tn/a\nplaza\t2\n");
    const demo::TsvTable table = readTsv(file);
    EXPECT_EQ(table.rows()[0].number("ms"), 1.5);
    EXPECT_TRUE(std::isnan(table.rows()[1].number("ms")));
    EXPECT_EQ(table.rows()[2].whole("ms"), 2);
}

TEST(TsvJournal, SaysWhereNumbersWithCommasAreNone) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "counts.tsv";
    TsvJournal journal(file, {"counts"}, "");
    journal.add({"1,20,3"});
    journal.add({""});
    journal.add({"1,x"});
    const demo::TsvTable table = readTsv(file);
    EXPECT_EQ(table.rows()[0].wholes("counts"), (std::vector<int>{1, 20, 3}));
    EXPECT_TRUE(table.rows()[1].wholes("counts").empty());
    try {
        table.rows()[2].wholes("counts");
        FAIL() << "no number is taken for one";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("counts.tsv: row 3, column counts: \"1,x\""));
    }
}

TEST(TsvJournal, BeginsAnewWhenItWasKilledInItsFirstLines) {
    for (const char* torn : {"", "# pro", "# program bench\n# pl", "# program bench\nscene\tm"}) {
        const tests::TemporaryFolder folder;
        const auto file = folder.path() / "times.tsv";
        std::ofstream(file) << torn;
        TsvJournal journal(file, {"scene", "ms"}, "program bench");
        journal.add({"yard", "1"});
        EXPECT_EQ(records::readWholeFile(file), "# program bench\nscene\tms\nyard\t1\n") << torn;
    }
}

TEST(TsvJournal, RefusesWhatItCannotGoOnWith) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "times.tsv";
    { TsvJournal journal(file, {"scene", "ms"}, "x"); }
    EXPECT_THAT(
        [&] {
            TsvJournal(file, {"scene", "s"}, "x");
        },
        testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("other columns")));
    std::ofstream(file, std::ios::app) << "one cell\n";
    EXPECT_THAT([&] { readTsv(file); }, testing::ThrowsMessage<std::runtime_error>(
                                            testing::HasSubstr("times.tsv:3: has 1 cells")));
    const auto words = folder.path() / "words.tsv";
    std::ofstream(words) << "ms\nfast\n1.5\n";
    const demo::TsvTable table = readTsv(words);
    EXPECT_THROW(table.rows()[0].number("ms"), std::runtime_error);
    EXPECT_THROW(table.rows()[1].whole("ms"), std::runtime_error);
    EXPECT_THROW(table.rows()[1].text("s"), std::runtime_error);
    EXPECT_THROW(readTsv(folder.path() / "none.tsv"), std::runtime_error);
}

}  // namespace
