"""nbgrader's settings for this course; nbgrader reads this file from the folder it is started in.

solutions/ holds the source version of each assignment. Everything else that nbgrader writes goes to
course/, which holds students' work and is in no repository: back it up.
"""

import os
import sys
from pathlib import Path

import zmq

from autograder import nbgrader_glue

# nbgrader starts `alembic` by its bare name, which is found only where the environment is activated.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])

nbgrader_glue.end_in_words()
root = Path(__file__).resolve().parent
course = root / "course"
problems = root / "problems"
nbgrader_glue.make_private(course)
(course / "exchange").mkdir(exist_ok=True)
problems.mkdir(exist_ok=True)

c = get_config()  # noqa: F821  (nbgrader defines it)

c.CourseDirectory.course_id = "armdyn"
c.CourseDirectory.root = str(root)
c.CourseDirectory.source_directory = "solutions"
c.CourseDirectory.release_directory = "course/release"
c.CourseDirectory.submitted_directory = "course/submitted"
c.CourseDirectory.autograded_directory = "course/autograded"
c.CourseDirectory.feedback_directory = "course/feedback"
c.CourseDirectory.solution_directory = "course/solution"
c.CourseDirectory.db_url = f"sqlite:///{course / 'gradebook.db'}"

# The exchange is in course/ as well, so that one account is enough to try everything. For students with
# accounts of their own, it has to be elsewhere: docs/class-server.md.
c.Exchange.root = str(course / "exchange")
c.ExchangeFactory.update(nbgrader_glue.EXCHANGE)
c.Exchange.cache = str(course / "cache")
# Fetch writes into problems/, and only what is not there yet; Submit hands in from there. An absolute
# path, because Assignment List works in that folder.
c.Exchange.assignment_dir = str(problems)
c.ExchangeFetchAssignment.replace_missing_files = True

c.GenerateAssignment.preprocessors = nbgrader_glue.generate_preprocessors()
c.GenerateAssignment.exporter_class = nbgrader_glue.RELEASE_EXPORTER
c.Autograde.sanitize_preprocessors = nbgrader_glue.sanitize_preprocessors()
c.Autograde.autograde_preprocessors = nbgrader_glue.autograde_preprocessors()
c.Autograde.exporter_class = nbgrader_glue.SUBMISSION_EXPORTER
# The right gradient of one's own wrong P is a wrong g, but no second mistake. It gets this share of its
# points: 0 for none, 1 for all. The card says so either way.
c.Judge.carried_on = 0.5
c.GenerateFeedback.preprocessors = nbgrader_glue.feedback_preprocessors()
c.GenerateFeedback.exporter_class = nbgrader_glue.FEEDBACK_EXPORTER
# The formgrader's pages and the feedback pages hold their formulas and pictures, and ask nothing of
# another host.
c.HTMLExporter.filters = nbgrader_glue.PAGE_FILTERS
c.HTMLExporter.extra_template_basedirs = nbgrader_glue.page_templates()
c.HTMLExporter.extra_template_paths = nbgrader_glue.templates_of_nbgrader()

c.Application.logging_config = nbgrader_glue.LOG
# Without, each kernel that Validate starts warns that others could read its traffic.
c.KernelManager.transport_encryption = "auto" if zmq.has("curve") else "disabled"
c.Execute.timeout = nbgrader_glue.VALIDATE_SECONDS

c.ClearSolutions.code_stub = {"python": nbgrader_glue.CODE_STUB}
c.ClearSolutions.text_stub = nbgrader_glue.TEXT_STUB
c.ExportApp.plugin_class = nbgrader_glue.GRADES_EXPORTER
c.ExportPlugin.to = "course/grades.csv"
