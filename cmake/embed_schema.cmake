# Writes schemas/archive.sql as a C++ string, without comments and blank lines.
# usage: cmake -DINPUT=archive.sql -DOUTPUT=schema_text.cc -P embed_schema.cmake
file(STRINGS "${INPUT}" lines)
set(text "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "--.*$" "" line "${line}")
  string(STRIP "${line}" line)
  if(NOT line STREQUAL "")
    # A list keeps its semicolons only as one string: put them back at the end of each statement.
    string(APPEND text "    R\"sql(${line})sql\" \"\\n\"\n")
  endif()
endforeach()
file(WRITE "${OUTPUT}"
     "#include \"store/schema.h\"\n\nnamespace reprise {\n\nconst char* schema_text() {\n  return\n${text}      ;\n}\n\n}  // namespace reprise\n")
