/// All of the core: everything that finds a pose in an image.
#pragma once

#include "dotpose/code.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/frame_pacer.hpp"
#include "dotpose/geometry.hpp"
#include "dotpose/image.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/option_fault.hpp"
#include "dotpose/options.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"
#include "dotpose/track.hpp"
