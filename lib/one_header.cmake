# bough_one_header(FILE HEADER...): FILE becomes what a program gets of HEADERs, one text without includes of ours, in their order. Whoever reads it sees the
# whole interface, and nothing else is installed. Made anew when one of them changes.
function(bough_one_header file)
  set(whole "")
  foreach(header ${ARGN})
    file(READ ${header} text)
    string(REGEX REPLACE "#include \"[^\n]*\n" "" text "${text}")
    string(REPLACE "#pragma once\n" "" text "${text}")
    string(APPEND whole "${text}\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  endforeach()
  file(CONFIGURE OUTPUT ${file} CONTENT "#pragma once\n@whole@" @ONLY)
endfunction()
