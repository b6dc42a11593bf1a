// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled with other containers of the standard library than the library, it must not be linked.
#include "lodestone/version.h"

int main() { lodestone::need_same_containers(); }
