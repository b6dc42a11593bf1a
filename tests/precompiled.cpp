// SPDX-License-Identifier: GPL-3.0-or-later
// Only there for the header to be compiled.
