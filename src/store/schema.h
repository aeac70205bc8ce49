// What identifies an archive file, and its tables.
#pragma once

#include <cstdint>

namespace reprise {

/// 'RPRS', in the header of the file. Never changes.
constexpr std::int32_t application_id = 0x52505253;
/// major * 1000 + minor. A reader refuses another major version that is newer; a newer minor
/// version only adds what an older reader may leave aside.
constexpr int format_version = 1000;

/// Bytes. Small, so that the half-empty page at the end of each table costs a small archive little.
constexpr int page_size = 1024;

/// The statements of schemas/archive.sql, one a line.
const char* schema_text();

}  // namespace reprise
