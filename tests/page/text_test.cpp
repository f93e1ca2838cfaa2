#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include <string>

#include "host/page/base64.hpp"
#include "host/page/deflate.hpp"

namespace whisker::page {
namespace {

TEST(Base64, GivesTheVectorsOfTheRfc) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

RC_GTEST_PROP(Deflate, IsUndoneByZlib, (const std::string& text)) {
  std::string out(text.size() + 1, '\0');
  const std::string small = deflated(text);
  uLongf size = static_cast<uLongf>(out.size());
  const int status =
      uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(small.data()),
                 static_cast<uLong>(small.size()));
  RC_ASSERT(status == Z_OK);
  out.resize(size);
  RC_ASSERT(out == text);
}

TEST(Deflate, MakesARowOfZerosSmall) { EXPECT_LT(deflated(std::string(100000, '\0')).size(), 200U); }

}  // namespace
}  // namespace whisker::page
