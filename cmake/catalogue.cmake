# Compiles a catalogue of messages and writes a C++ source that holds its bytes; nothing if MSGFMT is not given.
#   cmake -DPO=po/zh.po -DTO=FILE.cpp -DMSGFMT=… -P catalogue.cmake
set(bytes "")
if(MSGFMT)
  execute_process(COMMAND ${MSGFMT} --check -o ${TO}.mo ${PO} COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${TO}.mo bytes HEX)
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  string(REGEX REPLACE "(................................................................)" "\\1\"\n    \"" bytes "${bytes}")
endif()
file(WRITE ${TO} "// Made by cmake/catalogue.cmake from po/zh.po.
#include <string_view>

namespace alembert {

extern const std::string_view chinese_catalogue;

namespace {
constexpr char bytes[] =
    \"${bytes}\";
}  // namespace

const std::string_view chinese_catalogue(bytes, sizeof bytes - 1);

}  // namespace alembert
")
