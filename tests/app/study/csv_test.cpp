#include "app/study/csv.h"

#include <clocale>
#include <random>

#include <gtest/gtest.h>

#include "assets/load_error.h"
#include "tests/refusal.h"

namespace app {
namespace {

TEST(Csv, ReadsWhatSpreadsheetsWrite) {
  const CsvTable table =
      csvTableFrom("\xef\xbb\xbfparticipant,says\r\nP01,\"a, \"\"b\"\"\nc\"\r\n\r\n P02 , ü \r\n", "T");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.heads, (std::vector<std::string>{"participant", "says"}));
  EXPECT_EQ(table.rows[0].cells[1], "a, \"b\"\nc");
  EXPECT_EQ(table.rows[1].cells, (std::vector<std::string>{"P02", "ü"}));
  EXPECT_EQ(table.rows[1].line, 5);
}

TEST(Csv, RefusesWithTheLine) {
  const auto refusal = [](const std::string& text) {
    return tests::refusalOf<assets::LoadError>([&] { csvTableFrom(text, "T"); });
  };
  EXPECT_EQ(refusal(""), "T: it is empty, give a row of heads");
  EXPECT_EQ(refusal("a,b\n1\n"), "T line 2: it has 1 cell, the heads are 2");
  EXPECT_EQ(refusal("a,a\n"), "T line 1: the head \"a\" is there twice");
  EXPECT_EQ(refusal("a,,b\n"), "T line 1: a column has no head, or one that is no short word");
  EXPECT_EQ(refusal("a,\"b\nc\"\n"), "T line 1: a column has no head, or one that is no short word");
  EXPECT_NE(refusal("a\n\"b").find("T line 2: a quoted cell"), std::string::npos);
  EXPECT_NE(refusal("a\n\"b\"c\n").find("T line 2: a quoted cell"), std::string::npos);
  EXPECT_NE(refusal("a\n\xff\n").find("no UTF-8"), std::string::npos);
  EXPECT_NE(refusal(std::string("a\nb\0c\n", 6)).find("no UTF-8"), std::string::npos);
}

TEST(Csv, WritesSoThatItReadsBackAndNoFormulaIsRun) {
  const std::vector<std::string> cells{"plain", "a,b", "say \"x\"", "two\nlines", "-1.5", ""};
  EXPECT_EQ(csvTableFrom("a,b,c,d,e,f\n" + csvLine(cells), "T").rows[0].cells, cells);
  EXPECT_EQ(csvLine({"=HYPERLINK(1)", "@x", "-1", "+bad"}), "'=HYPERLINK(1),'@x,-1,'+bad\n");
}

TEST(CsvMutants, AreReadOrRefusedInOneLine) {
  std::mt19937 random(3);
  const std::string whole = "participant,group,V1\nP01,\"sur\"\"geon\",5\nP02,student,\n";
  for (int n = 0; n < 20'000; ++n) {
    std::string text = whole;
    for (int k = 0; k < 4; ++k) text[random() % text.size()] = "\",\n\r\xff x\0"[random() % 9];
    try {
      for (const CsvRow& row : csvTableFrom(text, "T").rows) EXPECT_FALSE(row.cells.empty());
    } catch (const assets::LoadError& refusal) {
      EXPECT_EQ(std::string(refusal.what()).find('\n'), std::string::npos) << refusal.what();
    }
  }
}

}  // namespace
}  // namespace app
