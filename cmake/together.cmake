# Files of one folder are compiled together (a "unity build"): the headers that they share, above all those of
# GiNaC and Eigen, are read and instantiated once instead of once per file. The 22 files of the room `formalism`
# take 12 s of processor time if they are compiled together, and 44 s one by one (g++ 12). The preset `debug`
# compiles each file by itself, which is faster for a person who changes one file after the other.
#   alembert_together(TARGET [MOST COUNT] [ALONE FILE...])
# At most COUNT files (24) form a group, so that two processors have work, and each has enough with a gigabyte and a
# half. The files after ALONE use the same short names for different things and are compiled by themselves.
function(alembert_together target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "MOST" "ALONE")
  set(most 24)
  if(ALEMBERT_MOST_TOGETHER)  # web/read.sh
    set(most ${ALEMBERT_MOST_TOGETHER})
  elseif(arg_MOST)
    set(most ${arg_MOST})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(REMOVE_ITEM sources ${arg_ALONE})
  set(rooms "")
  foreach(source IN LISTS sources)
    get_filename_component(room ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "room_${room}" room)
    list(APPEND rooms "${room}")
    list(APPEND files_${room} ${source})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    list(LENGTH files_${room} count)
    math(EXPR parts "(${count} + ${most} - 1) / ${most}")
    set(place 0)
    foreach(source IN LISTS files_${room})
      math(EXPR part "${place} * ${parts} / ${count}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${part})
      math(EXPR place "${place} + 1")
    endforeach()
  endforeach()
endfunction()
