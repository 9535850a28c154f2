# Installs the headers of the generator's rooms under alembert/, so that no folder named `scene` or `model` stands in a user's
# include path: inside the repository a header is "model/mechanism.hpp", installed it is "alembert/model/mechanism.hpp".
# Needs SOURCE (the folder generator/) and INCLUDE (where the runtime's headers go, relative to the prefix).
file(STRINGS ${SOURCE}/rooms.txt lines REGEX "^[a-z]")
set(rooms "")
foreach(line IN LISTS lines)
  string(REGEX MATCH "^[a-z]+" room "${line}")
  if(NOT room MATCHES "^(report|urdf|commands)$")  # rooms that only the program uses
    list(APPEND rooms ${room})
  endif()
endforeach()
list(JOIN rooms "|" any)
foreach(room IN LISTS rooms ITEMS .)  # and alembert.hpp, all of them in one header
  file(GLOB headers RELATIVE ${SOURCE} ${SOURCE}/${room}/*.hpp)
  foreach(header IN LISTS headers)
    file(READ ${SOURCE}/${header} text)
    string(REGEX REPLACE "#include \"(${any})/" "#include \"alembert/\\1/" text "${text}")
    file(WRITE $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${INCLUDE}/alembert/${header} "${text}")
  endforeach()
endforeach()
