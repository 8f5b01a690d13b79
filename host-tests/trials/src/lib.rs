//! Statistics of trials.
