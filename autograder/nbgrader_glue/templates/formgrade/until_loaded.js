// nbgrader writes the points and comments that it fetches over what was typed before they came.
(function () {
  const fields = $(".score, .extra-credit, .comment");
  const buttons = $(".scoring-buttons button");
  const open = (isOpen) => {
    fields.prop("readOnly", !isOpen);
    buttons.prop("disabled", !isOpen);
  };
  open(false);
  $(document).on("ajaxComplete.until", () => {
    if (formgrader.grades?.loaded && formgrader.comments?.loaded) {
      $(document).off("ajaxComplete.until");
      open(true);
    }
  });
})();
