#include "formats/whole_file.h"

#include "model/new_file.h"

namespace reprise {

void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      std::string_view what) {
  NewFile file(path, what);
  file.write(text);
  file.replace();
}

}  // namespace reprise
