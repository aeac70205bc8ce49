# embed_schema(INPUT OUTPUT): writes a .sql file as a C++ string, without comments and blank lines, one
# statement a line. Done when configuring, and again when the file changes.
function(embed_schema input output)
  set_property(
    DIRECTORY ${PROJECT_SOURCE_DIR}
    APPEND
    PROPERTY CMAKE_CONFIGURE_DEPENDS ${input})
  file(READ "${input}" text)
  string(REGEX REPLACE "--[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n[ \n]*" "\n" text "${text}")
  string(STRIP "${text}" text)
  file(
    CONFIGURE
    OUTPUT ${output}
    CONTENT
      "#include \"store/schema.h\"\n\nnamespace reprise {\n\nconst char* schema_text() { return R\"sql(${text})sql\"; }\n\n}  // namespace reprise\n"
    @ONLY)
endfunction()
