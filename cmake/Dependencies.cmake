# SPDX-License-Identifier: MIT
# Every third-party library, found once. packages.txt beside this file names the Debian packages.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs quality)
find_package(assimp 5.2 REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(glm REQUIRED)
find_package(glfw3 3.3 REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)
pkg_check_modules(stb REQUIRED IMPORTED_TARGET stb)
