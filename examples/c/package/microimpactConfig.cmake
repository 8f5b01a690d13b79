# find_package(microimpact) gives the target microimpact::microimpact: the static library, its headers, and the mathematical functions of C
# where they are a library of their own.
get_filename_component(microimpact_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET microimpact::microimpact)
    add_library(microimpact::microimpact STATIC IMPORTED)
    set_target_properties(microimpact::microimpact PROPERTIES
        IMPORTED_LOCATION "${microimpact_prefix}/lib/libmicroimpact_c.a"
        INTERFACE_INCLUDE_DIRECTORIES "${microimpact_prefix}/include")
    if(UNIX)
        set_property(TARGET microimpact::microimpact PROPERTY INTERFACE_LINK_LIBRARIES m)
    endif()
endif()
unset(microimpact_prefix)
