"""Submissions as students send them: right ones, wrong ones and damaged ones."""
