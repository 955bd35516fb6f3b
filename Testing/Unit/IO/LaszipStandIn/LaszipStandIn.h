/// @file
/// What the tests ask LASzip's stand-in.
#pragma once

/// Readers created and not destroyed.
int openLaszipReaders();
