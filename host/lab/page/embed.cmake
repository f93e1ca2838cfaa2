# Turns the file IN into the C++ source OUT, which defines NAMESPACE::template_parts(), declared in HEADER. It has several
# string literals, because compilers limit a literal to 64 KiB.
file(READ ${IN} text)
if(text MATCHES "[)]page\"")
  message(FATAL_ERROR "${IN}: holds the end of a raw string")
endif()
string(LENGTH "${text}" length)
set(parts "")
set(count 0)
set(from 0)
while(from LESS length)
  string(SUBSTRING "${text}" ${from} 32000 part)
  string(APPEND parts "    R\"page(${part})page\",\n")
  math(EXPR from "${from} + 32000")
  math(EXPR count "${count} + 1")
endwhile()
file(WRITE ${OUT} "#include \"${HEADER}\"

namespace whisker::${NAMESPACE} {

const std::vector<std::string_view>& template_parts() {
  static const std::vector<std::string_view> parts = {
${parts}  };
  return parts;
}

}  // namespace whisker::${NAMESPACE}
")
