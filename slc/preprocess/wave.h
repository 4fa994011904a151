// Boost.Wave's headers, which are not written for our warning level. Included by preprocess.cpp only.
#pragma once
#pragma GCC system_header

#include <boost/wave.hpp>
#include <boost/wave/cpplexer/cpp_lex_iterator.hpp>
#include <boost/wave/cpplexer/cpp_lex_token.hpp>
