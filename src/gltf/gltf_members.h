// The members of a glTF file that this program reads, and their JSON types.
#pragma once

#include <span>
#include <string_view>

namespace wavepath {

struct Member {
    std::string_view of;    // the kind of object that has it; that of the file itself is "root"
    std::string_view name;  // "*": every member
    // boolean, number, text; index: -1 .. 2^31 - 1, where -1 counts as none; size: 0 .. 2^64 - 1,
    // of bytes or rows; else the kind of object that it is. Then "[]": an array of these; "!": it
    // has to be there; "?": it may be of another type, and then means nothing here.
    std::string_view type;
};

std::span<const Member> members_read();

}  // namespace wavepath
