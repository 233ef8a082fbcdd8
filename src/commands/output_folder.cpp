#include "commands/output_folder.h"

#include "error.h"
#include "image/exr_writer.h"

namespace wavepath {

void make_output_folder(const std::filesystem::path& folder, const std::filesystem::path& file) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error(
            "{}: no folder can be made there: {}; choose another", folder.string(),
            failure.message());
    check_writable(folder / file);
}

}  // namespace wavepath
