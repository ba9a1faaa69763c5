// sanitizers.h: which sanitizers the code is compiled with, 1 or 0. GCC defines names for them, clang asks by __has_feature.
#pragma once

#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define BOUGH_ADDRESS_SANITIZER 1
#endif
#if __has_feature(thread_sanitizer)
#define BOUGH_THREAD_SANITIZER 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) && !defined(BOUGH_ADDRESS_SANITIZER)
#define BOUGH_ADDRESS_SANITIZER 1
#endif
#if defined(__SANITIZE_THREAD__) && !defined(BOUGH_THREAD_SANITIZER)
#define BOUGH_THREAD_SANITIZER 1
#endif
#ifndef BOUGH_ADDRESS_SANITIZER
#define BOUGH_ADDRESS_SANITIZER 0
#endif
#ifndef BOUGH_THREAD_SANITIZER
#define BOUGH_THREAD_SANITIZER 0
#endif
