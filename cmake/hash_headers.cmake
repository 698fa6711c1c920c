# Writes compiled_against.hpp where the text of a header of the folder `source` has changed: cmake -Dsource=... -Dto=... -P
file(GLOB_RECURSE headers RELATIVE ${source} ${source}/*.hpp ${source}/*_cards.yaml)
list(SORT headers)
foreach(header ${headers})
  file(SHA256 ${source}/${header} hash)
  string(APPEND text "${header} ${hash}\n")
endforeach()
string(SHA256 COURANT_HEADERS "${text}")
configure_file(${source}/extension/compiled_against.hpp.in ${to} @ONLY)
