  # For the module in the assessment's configuration file. Written by `raysteps export autolab`.
  # What the grader gives no score for, be it that it failed or that its job was killed, stays as it was.
  def parseAutoresult(autoresult, _isOfficial)
    ActiveSupport::JSON.decode(autoresult)["scores"] || { "not graded" => nil }
  rescue StandardError
    { "not graded" => nil }
  end

  def modifySubmissionScores(scores, _previous_submissions, _problems)
    scores.compact
  end
