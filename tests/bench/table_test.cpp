#include "bench/table.h"

#include <gtest/gtest.h>

namespace quincunx {
namespace {

const Table kTable{.headings = {"way", "ms"}, .rows = {{"exact", "7"}, {"march", "1250"}}, .left = 1};

TEST(Table, AlignsWordsLeftAndNumbersRight) {
  EXPECT_EQ(plain_text(kTable),
            "way      ms\n"
            "exact     7\n"
            "march  1250\n");
}

TEST(Table, IsMarkdownWithTheSameColumns) {
  EXPECT_EQ(markdown_text(kTable),
            "| way   |   ms |\n"
            "|:------|-----:|\n"
            "| exact |    7 |\n"
            "| march | 1250 |\n");
}

}  // namespace
}  // namespace quincunx
